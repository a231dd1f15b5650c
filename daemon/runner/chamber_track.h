#pragma once

#include <deque>
#include <optional>

#include "compensation/values/units.h"
#include "drivers/clock.h"

namespace gyrocal::runner {

/// Between readings this far apart the air of a cabinet still goes in a straight line.
inline constexpr Duration air_is_straight_over = std::chrono::seconds{60};

/// The chamber's last readings, and what it did between them: straight lines. Means over the
/// intervals of the slow stream and over dwells come from here, so that they do not depend on how
/// polls fall into intervals.
class ChamberTrack {
 public:
  /// Over gaps between readings longer than this nothing is claimed.
  explicit ChamberTrack(Duration gap_max) : gap_max_(gap_max) {}

  /// In order of time.
  void observe(Duration t, Celsius actual, Celsius setpoint);
  /// What is older than `t` will not be asked for again.
  void forget_before(Duration t);

  /// Mean of the air over [from, to]; nothing unless readings reach across it without a gap.
  [[nodiscard]] std::optional<Celsius> mean(Duration from, Duration to) const;
  /// Same for an interval that has just ended: where readings do not reach its end yet, over the
  /// part they cover. Nothing if the latest is older than a gap may be.
  [[nodiscard]] std::optional<Celsius> mean_so_far(Duration from, Duration to) const;
  /// Highest minus lowest reading within [from, to]; nothing without readings.
  [[nodiscard]] std::optional<Kelvin> peak_to_peak(Duration from, Duration to) const;
  /// What the chamber controlled to at t.
  [[nodiscard]] std::optional<Celsius> setpoint(Duration t) const;
  [[nodiscard]] std::optional<Duration> latest() const;
  [[nodiscard]] Duration gap_max() const { return gap_max_; }

 private:
  struct Reading {
    Duration t;
    Celsius actual;
    Celsius setpoint;
  };
  Duration gap_max_;
  std::deque<Reading> readings_;
};

}  // namespace gyrocal::runner
