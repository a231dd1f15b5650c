#pragma once

#include <cstddef>
#include <vector>

#include "compensation/values/records.h"

namespace gyrocal::status {

/// What the plots show at one instant. NaN (`missing`): not known then.
struct Point {
  struct Board {
    double board_c = missing;
    double rate_z_dps = missing;
    double slope_k_per_h = missing;
  };
  double t_s = 0;  ///< campaign time
  double chamber_c = missing;
  double setpoint_c = missing;
  std::vector<Board> boards;
};

/// A campaign's past for the plots, in bounded space: means over intervals of equal length. When
/// `points_max` is reached the intervals double, so that a weekend takes no more room, and no more
/// time to draw, than an hour.
class History {
 public:
  explicit History(std::size_t points_max = 1000, double interval_s = 5)
      : points_max_(points_max), interval_s_(interval_s) {}

  /// Points come in order of time; one before the latest interval is left out.
  void add(const Point& point);
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] double interval_s() const { return interval_s_; }

 private:
  [[nodiscard]] double interval_of(double t_s) const;
  void coarsen();

  std::size_t points_max_;
  double interval_s_;
  std::vector<Point> points_;  ///< means; the last one still grows
  std::vector<int> gathered_;  ///< how many made each
};

}  // namespace gyrocal::status
