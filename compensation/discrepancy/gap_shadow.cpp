#include "compensation/discrepancy/gap_shadow.h"

#include <algorithm>
#include <cmath>

#include "compensation/rig/thermal_lags.h"

namespace gyrocal {
namespace {

constexpr double gap_s_min = 60;
constexpr double gap_intervals_min = 4;

/// The die as the last sensor before it drives it: the chamber's through board and die, or, where
/// there is no chamber's, the board's through the die.
class Die {
 public:
  Die(bool from_chamber, const Track& track, double start_c)
      : from_chamber_(from_chamber),
        board_(track.board_sensor.tau_s, start_c),
        die_(track.die_tau_s, start_c) {}

  double advance(double dt_s, double input_c) {
    return die_.advance(dt_s, from_chamber_ ? board_.advance(dt_s, input_c) : input_c);
  }

 private:
  bool from_chamber_;
  rig::ThermalLag board_, die_;
};

using Reading = double MonitorRow::*;

/// The first row from `from` on that has a reading; the number of rows: none.
std::size_t next_with(const Session& session, Reading reading, std::size_t from) {
  while (from < session.monitor.size() && std::isnan(session.monitor[from].*reading)) ++from;
  return from;
}

}  // namespace

std::vector<std::size_t> rows_in_gap_shadow(const Session& session, const Track& track) {
  const auto& rows = session.monitor;
  const bool from_chamber = next_with(session, &MonitorRow::chamber_c, 0) < rows.size();
  const Reading reading = from_chamber ? &MonitorRow::chamber_c : &MonitorRow::board_c;
  const std::size_t first = next_with(session, reading, 0);
  if (first == rows.size()) return {};

  const double gap_s = std::max(gap_s_min, gap_intervals_min * session.monitor_interval_s);
  std::vector<std::size_t> shadowed;
  Die jumped_early(from_chamber, track, rows[first].*reading), jumped_late = jumped_early;
  std::size_t left = first;
  for (std::size_t right = first; left + 1 < rows.size(); left = right) {
    right = next_with(session, reading, left + 1);
    if (right == rows.size()) break;
    const double from_c = rows[left].*reading, to_c = rows[right].*reading;
    const bool is_gap = rows[right].t_s - rows[left].t_s > gap_s;
    if (is_gap) jumped_early.advance(0, to_c);
    for (std::size_t k = left + 1; k <= right; ++k) {
      const double dt_s = rows[k].t_s - rows[k - 1].t_s;
      const double straight_c = from_c + (to_c - from_c) * (rows[k].t_s - rows[left].t_s) /
                                             (rows[right].t_s - rows[left].t_s);
      const double early_c = jumped_early.advance(dt_s, is_gap ? to_c : straight_c);
      const double late_c = jumped_late.advance(dt_s, is_gap ? from_c : straight_c);
      if (std::abs(early_c - late_c) > gap_shadow_c) shadowed.push_back(k);
    }
    if (is_gap) jumped_late.advance(0, to_c);
  }
  return shadowed;
}

}  // namespace gyrocal
