#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compensation/values/records.h"
#include "drivers/clock.h"

namespace gyrocal::runner {

/// One board's part of a dwell.
struct CollectedDwell {
  std::size_t board = 0;
  std::vector<BoardSample> samples;
  std::int64_t frames_missing = 0;
  double board_mean_c = missing;
  std::optional<std::string> reject_reason;
};

/// Collects the samples of one dwell from all boards at once.
class DwellCollector {
 public:
  /// @param lost_share_max  of the frames a board sent; beyond it its dwell is rejected.
  DwellCollector(int samples_per_dwell, double lost_share_max)
      : wanted_samples_(static_cast<std::size_t>(samples_per_dwell)),
        lost_share_max_(lost_share_max) {}

  /// A dwell begins at t with these boards; the samples of others are not kept.
  void begin(Duration t, std::span<const std::size_t> boards);
  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] Duration began() const { return began_; }

  void add(std::size_t board, std::span<const BoardSample> samples);
  /// This board will send no more: its dwell is rejected with the reason.
  void spoil(std::size_t board, const std::string& reason);
  /// What was wrong from the first to the last sample of a part; nothing if all was well.
  using Trouble = std::function<std::optional<std::string>(Duration from, Duration to)>;
  /// Asks about each board's interval; a board whose interval had trouble has its dwell rejected.
  void look_back(const Trouble& trouble);

  /// Every board has all its samples or is spoilt.
  [[nodiscard]] bool full() const;
  /// Why a board's part will be rejected, and which board's; nothing if all are good.
  struct Shortfall {
    std::size_t board;
    std::string reason;
  };
  [[nodiscard]] std::optional<Shortfall> shortfall() const;
  /// Share of the samples collected, the slowest board's.
  [[nodiscard]] double progress() const;
  /// Ends the dwell. With a reason every board's part is rejected with it; without one, each that
  /// lost too much is.
  [[nodiscard]] std::vector<CollectedDwell> finish(const std::optional<std::string>& reason);

 private:
  struct Part {
    CollectedDwell dwell;
    bool spoilt = false;
  };
  [[nodiscard]] Part* part(std::size_t board);
  [[nodiscard]] std::optional<std::string> verdict(const Part& part) const;

  std::size_t wanted_samples_;
  double lost_share_max_;
  bool running_ = false;
  Duration began_{};
  std::vector<Part> parts_;
};

}  // namespace gyrocal::runner
