#include "compensation/rig/driver_track.h"

#include <cmath>

#include "compensation/rig/thermal_lags.h"

namespace gyrocal::rig {
namespace {

/// The column with its holes filled by the last value (the first one before that); empty if there
/// is none at all.
std::vector<double> filled(std::span<const MonitorRow> monitor, double MonitorRow::*column) {
  std::vector<double> values(monitor.size());
  std::size_t first = 0;
  while (first < monitor.size() && std::isnan(monitor[first].*column)) ++first;
  if (first == monitor.size()) return {};
  double last = monitor[first].*column;
  for (std::size_t i = 0; i < monitor.size(); ++i) {
    if (!std::isnan(monitor[i].*column)) last = monitor[i].*column;
    values[i] = last;
  }
  return values;
}

/// Slope [1/min] of the least-squares line through the rows within +-reach of each row.
std::vector<double> slopes_per_min(std::span<const MonitorRow> monitor,
                                   const std::vector<double>& values, double reach_s) {
  std::vector<double> slopes(values.size(), 0.0);
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (monitor[low].t_s < monitor[i].t_s - reach_s) ++low;
    while (high < values.size() && monitor[high].t_s <= monitor[i].t_s + reach_s) ++high;
    std::size_t from = low, to = high;  // [from, to): at least the neighbours
    if (to - from < 3) {
      from = i > 0 ? i - 1 : 0;
      to = std::min(values.size(), i + 2);
    }
    double t = 0, y = 0, tt = 0, ty = 0;
    for (std::size_t k = from; k < to; ++k) {
      t += monitor[k].t_s - monitor[i].t_s;
      y += values[k] - values[i];
    }
    const double n = static_cast<double>(to - from);
    for (std::size_t k = from; k < to; ++k) {
      const double dt = monitor[k].t_s - monitor[i].t_s - t / n;
      tt += dt * dt;
      ty += dt * (values[k] - values[i] - y / n);
    }
    if (tt > 0.0) slopes[i] = ty / tt * 60.0;
  }
  return slopes;
}

}  // namespace

std::vector<Drivers> track_drivers(std::span<const MonitorRow> monitor, double board_tau_s,
                                   double die_tau_s, double smoothing_s) {
  const std::vector<double> chamber_c = filled(monitor, &MonitorRow::chamber_c);
  const std::vector<double> board_c = filled(monitor, &MonitorRow::board_c);
  const bool from_air = !chamber_c.empty();
  const std::vector<double>& source_c = from_air ? chamber_c : board_c;
  if (source_c.empty()) return {};
  const std::vector<double> rate = slopes_per_min(monitor, source_c, smoothing_s);

  std::vector<Drivers> track(monitor.size());
  BoardThermals thermals(board_tau_s, die_tau_s, source_c.front());
  ThermalLag die(die_tau_s, source_c.front());
  for (std::size_t i = 0; i < monitor.size(); ++i) {
    const double dt_s = i == 0 ? 0.0 : monitor[i].t_s - monitor[i - 1].t_s;
    thermals.advance(dt_s, source_c[i]);
    die.advance(dt_s, source_c[i]);
    Drivers& now = track[i];
    now.t_s = monitor[i].t_s;
    now.t_on_s = monitor[i].t_s;
    now.setpoint_c = std::isnan(monitor[i].setpoint_c) ? source_c[i] : monitor[i].setpoint_c;
    now.chamber_c = source_c[i];
    now.chamber_rate_c_per_min = rate[i];
    now.board_c = from_air ? thermals.board_c() : source_c[i];
    now.die_c = from_air ? thermals.die_c() : die.value();
    now.die_rate_c_per_min = (now.board_c - now.die_c) / die_tau_s * 60.0;
  }
  return track;
}

}  // namespace gyrocal::rig
