#pragma once

#include <algorithm>
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
  /// Over gaps between readings longer than these nothing is claimed.
  /// @param dwell_gap_max  of a dwell's mean, where it is the longer: a dwell's air was seen to
  /// stand still before.
  ChamberTrack(Duration gap_max, Duration dwell_gap_max)
      : gap_max_(gap_max), dwell_gap_max_(std::max(gap_max, dwell_gap_max)) {}

  /// In order of time.
  void observe(Duration t, Celsius actual, Celsius setpoint);
  /// What is older than `t` will not be asked for again.
  void forget_before(Duration t);

  /// Mean of the air over [from, to]; nothing unless readings reach across it without a gap.
  [[nodiscard]] std::optional<Celsius> mean(Duration from, Duration to) const;
  /// Same for a dwell that has just ended: where readings do not reach its end yet, over the part
  /// they cover. Nothing if the latest is older than a gap may be.
  [[nodiscard]] std::optional<Celsius> dwell_mean(Duration from, Duration to) const;
  /// Highest minus lowest reading within [from, to]; nothing without readings.
  [[nodiscard]] std::optional<Kelvin> peak_to_peak(Duration from, Duration to) const;
  /// What the chamber controlled to at t.
  [[nodiscard]] std::optional<Celsius> setpoint(Duration t) const;
  [[nodiscard]] std::optional<Duration> latest() const;
  [[nodiscard]] Duration dwell_gap_max() const { return dwell_gap_max_; }

 private:
  struct Reading {
    Duration t;
    Celsius actual;
    Celsius setpoint;
  };
  [[nodiscard]] std::optional<Celsius> mean(Duration from, Duration to, Duration gap_max) const;

  Duration gap_max_, dwell_gap_max_;
  std::deque<Reading> readings_;
};

}  // namespace gyrocal::runner
