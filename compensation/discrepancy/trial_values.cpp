#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {
namespace {

using Values = std::vector<double>;
using Rows = std::vector<Values>;

struct Extent {
  double t_min_s, t_max_s, die_min_c, die_max_c;
};

Extent extent_of(const Track& track) {
  Extent extent{track.record.front().t_s, track.record.back().t_s, 1e9, -1e9};
  for (const rig::Drivers& now : track.record) {
    extent.die_min_c = std::min(extent.die_min_c, now.die_c);
    extent.die_max_c = std::max(extent.die_max_c, now.die_c);
  }
  return extent;
}

/// Every combination of the columns' values.
Rows product(const std::vector<Values>& columns) {
  Rows rows{{}};
  for (const Values& column : columns) {
    Rows longer;
    for (const Values& row : rows) {
      for (const double value : column) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    }
    rows = std::move(longer);
  }
  return rows;
}

Values steps(double low, double high, double step) {
  Values values;
  const int n = std::max(1, static_cast<int>(std::ceil((high - low) / step)));
  for (int i = 0; i <= n; ++i) values.push_back(low + (high - low) * i / n);
  return values;
}

/// A narrow feature needs its place known to a fraction of its width: a coarse grid of places keeps
/// only half of an off-grid bump (discrepancy_methods.md, trap 5).
Rows places_and_widths(const Extent& extent, const Values& rest) {
  Rows rows;
  for (const double w : {0.5, 0.9, 1.6, 2.8, 5.0}) {
    for (const double t0 : steps(extent.die_min_c, extent.die_max_c, std::max(0.5, 0.7 * w))) {
      Values row{1.0, t0, w};
      row.insert(row.end(), rest.begin(), rest.end());
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

std::vector<std::vector<double>> trial_values(const rig::Effect& effect, const rig::Law& law,
                                              const Track& track) {
  const Extent extent = extent_of(track);
  const std::string name = std::string(effect.name) + "/" + std::string(law.info.name);
  const Values lag{15, 30, 60, 120, 240, 480, 900};
  const Values relaxation{600, 1200, 2400, 4800, 9600, 14400};
  if (effect.name == "temperature_rate") return {rig::usual_values(law)};
  if (name == "thermal_lag/pole" || name == "thermal_lag/cascade") return product({lag});
  if (name == "thermal_lag/lead") return product({{10, 25, 60}});
  if (name == "thermal_hysteresis/play") {
    return product({{1}, {0.5, 0.75, 1.1, 1.7, 2.5, 4, 6, 10}});
  }
  if (name == "thermal_hysteresis/play_pair") return {{1, 0.7, 2.5}, {1, 1, 5}, {1, 2, 9}};
  if (name == "thermal_hysteresis/relay") {
    const double span = extent.die_max_c - extent.die_min_c;
    return product({{1}, steps(extent.die_min_c, extent.die_max_c, span / 12), {0.5, 1.5, 4, 8}});
  }
  if (name == "thermal_hysteresis/direction") return product({{1}, {0.4, 0.8, 1.6, 4}});
  if (name == "self_heating/die") return product({{-1.5, 1.5}, {60, 180, 500, 1200, 2000}, {0.3}});
  if (name == "self_heating/direct") return product({{1}, {60, 120, 250, 500, 1000, 2000}});
  if (name == "compressor_vibration/step") return {{1}};
  if (name == "g_sensitivity/measured") return product({{1}, {-8, -1, 0, 1, 8}, {-8, -1, 0, 1, 8}});
  if (name == "aging_drift/linear") return {{1}};
  if (effect.name == "aging_drift") return product({{1}, {0.5, 2, 8}});
  if (name == "bias_jump/step") {
    return product(
        {{1}, steps(extent.t_min_s, extent.t_max_s, (extent.t_max_s - extent.t_min_s) / 600)});
  }
  if (name == "mode_crossing/mixed") {
    Rows rows = places_and_widths(extent, {-45});
    for (Rows more = places_and_widths(extent, {45}); Values & row : more) rows.push_back(row);
    return rows;
  }
  if (effect.name == "mode_crossing") return places_and_widths(extent, {});
  if (effect.name == "condensation_step") {
    return product({{1}, {-5, -2, 1, 4, 7, 10, 12}, {60, 120, 300}, {900, 1800, 3600}});
  }
  if (name == "stress_relaxation/one_time") return product({{1}, relaxation});
  if (name == "stress_relaxation/two_times") {
    return {{1, 600, 4800, 0.5}, {1, 1200, 9600, 0.5}, {1, 2400, 14400, 0.5}};
  }
  if (name == "stress_relaxation/spread") return product({{1}, {900, 2400, 6000}, {0.4}});
  return {};
}

}  // namespace gyrocal
