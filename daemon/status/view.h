#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/runner/campaign_runner.h"
#include "daemon/status/concern.h"
#include "daemon/status/facts.h"
#include "daemon/status/history.h"
#include "daemon/status/mailbox.h"

namespace gyrocal::status {

/// All that a page, a metric or a message says about a campaign; made once, then only read.
struct View {
  Facts facts;
  std::optional<runner::Snapshot> now;  ///< absent: it has not begun
  std::int64_t utc_ns = 0;              ///< when this was made
  double silent_s = 0;                  ///< since the loop last reported, in the machine's time
  std::vector<EventInsert> events;      ///< the latest, oldest first
  std::uint64_t events_total = 0;       ///< that there have been
  std::vector<Point> history;
  Concern concern;
  std::uint64_t version = 0;  ///< grows
};

/// A board of the view, in physical units.
struct BoardView {
  std::string name;
  bool present = false;
  bool given_up = false;
  std::string trouble;
  double board_c = missing;
  std::array<double, 3> rate_dps{missing, missing, missing};  ///< means of the latest 5 s
  double frames_per_s = missing;
  std::optional<double> slope_k_per_h;
  double slope_limit_k_per_h = 0;
  std::uint64_t frames = 0;
  std::uint64_t frames_missing = 0;
  std::uint64_t restarts = 0;
  double lost_share = 0;
};
[[nodiscard]] std::vector<BoardView> boards_of(const Facts& facts, const runner::Snapshot& now);

/// Whether the chamber's last believed reading is so old that it says nothing of the present.
[[nodiscard]] bool chamber_is_stale(const Facts& facts, const runner::Snapshot& now);

/// UTC of an instant of campaign time, as far as the present one tells.
[[nodiscard]] std::int64_t utc_of(const View& view, Duration t);

/// Folds what the loop reports into views. Pure: times come from the caller.
class LiveStatus {
 public:
  explicit LiveStatus(Facts facts) { view_.facts = std::move(facts); }

  /// What an earlier run of the daemon has left, before anything else.
  void remember(std::vector<EventInsert> events, const std::vector<Point>& history);
  void report(const runner::Snapshot& now, double machine_s);
  void report(const EventInsert& event);
  /// All that a mailbox held.
  void report(const Mailbox::Content& content, double machine_s);
  /// @param machine_s  the machine's steady time.
  [[nodiscard]] const View& at(std::int64_t utc_ns, double machine_s);

  static constexpr std::size_t events_shown = 500;

 private:
  View view_;
  History history_;
  std::optional<double> reported_s_;
  std::optional<double> first_s_;
};

}  // namespace gyrocal::status
