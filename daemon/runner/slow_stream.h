#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compensation/values/records.h"
#include "daemon/campaign/plan.h"
#include "drivers/clock.h"

namespace gyrocal::runner {

inline constexpr Duration monitor_interval = seconds(campaign::monitor_interval_s);

/// Sums of one board's samples over one interval of the slow stream.
struct SlowInterval {
  Duration begin{};
  std::int64_t frames = 0;
  std::int64_t frames_missing = 0;
  std::array<std::int64_t, 3> gyro_sum_lsb{};
  std::int64_t temperature_sum_raw = 0;
  std::int64_t temperatures = 0;

  [[nodiscard]] double gyro_mean_lsb(std::size_t axis) const;
  [[nodiscard]] double board_c() const;  ///< `missing` if no frame carried it
};

/// Cuts one board's samples into intervals aligned to the campaign's start. It sees every sample of
/// the campaign once, ramps included.
class SlowStream {
 public:
  /// @param begin  the first interval starts at the multiple of `interval` at or before it.
  SlowStream(Duration interval, Duration begin);

  /// Samples in order of time; those of an interval already closed count into the present one.
  void add(std::span<const BoardSample> samples);
  /// No sample before `t` will come any more: closes what ended by then.
  void close_before(Duration t);
  /// The closed intervals, oldest first; empty ones (the board was away) included.
  [[nodiscard]] std::vector<SlowInterval> take();

 private:
  void close();

  Duration interval_;
  SlowInterval current_;
  std::optional<std::uint32_t> last_counter_;
  std::vector<SlowInterval> closed_;
};

}  // namespace gyrocal::runner
