#include "daemon/status/history.h"

#include <cmath>
#include <utility>

namespace gyrocal::status {
namespace {

/// Mean of `weight` values so far and one of `more`; what is missing leaves the other as it is.
double merged(double mean, int weight, double value, int more) {
  if (std::isnan(value)) return mean;
  if (std::isnan(mean)) return value;
  return (mean * weight + value * more) / (weight + more);
}

void merge(Point& into, int weight, const Point& point, int more) {
  into.t_s = merged(into.t_s, weight, point.t_s, more);
  into.chamber_c = merged(into.chamber_c, weight, point.chamber_c, more);
  into.setpoint_c = point.setpoint_c;  // a mean of setpoints is none
  if (into.boards.size() < point.boards.size()) into.boards.resize(point.boards.size());
  for (std::size_t i = 0; i < point.boards.size(); ++i) {
    auto& board = into.boards[i];
    const auto& add = point.boards[i];
    board.board_c = merged(board.board_c, weight, add.board_c, more);
    board.rate_z_dps = merged(board.rate_z_dps, weight, add.rate_z_dps, more);
    board.slope_k_per_h = merged(board.slope_k_per_h, weight, add.slope_k_per_h, more);
  }
}

}  // namespace

double History::interval_of(double t_s) const { return std::floor(t_s / interval_s_); }

void History::add(const Point& point) {
  if (!points_.empty() && interval_of(point.t_s) < interval_of(points_.back().t_s)) return;
  if (!points_.empty() && interval_of(point.t_s) == interval_of(points_.back().t_s)) {
    merge(points_.back(), gathered_.back()++, point, 1);
    return;
  }
  points_.push_back(point);
  gathered_.push_back(1);
  while (points_.size() > points_max_) coarsen();
}

void History::coarsen() {
  interval_s_ *= 2;
  const auto fine = std::exchange(points_, {});
  const auto weights = std::exchange(gathered_, {});
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (!points_.empty() && interval_of(fine[i].t_s) == interval_of(points_.back().t_s)) {
      merge(points_.back(), gathered_.back(), fine[i], weights[i]);
      gathered_.back() += weights[i];
    } else {
      points_.push_back(fine[i]);
      gathered_.push_back(weights[i]);
    }
  }
}

}  // namespace gyrocal::status
