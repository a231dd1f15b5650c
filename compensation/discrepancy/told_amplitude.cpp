#include "compensation/discrepancy/told_amplitude.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

/// Drift per g along the axis that changed most: what an axis that did not change would do is
/// anybody's guess.
double sensitivity_where_it_tilted(const SlowFinding& finding, const SlowModel& model) {
  const auto& record = model.track().record;
  const auto course =
      rig::drift_over(*finding.term->law, finding.term->values, model.bias(), record);
  double widest_g = 0, sensitivity = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const rig::Drivers& a, const rig::Drivers& b) {
      return a.acc_g[axis] < b.acc_g[axis];
    };
    const auto [low, high] = std::minmax_element(record.begin(), record.end(), less);
    const double range_g = high->acc_g[axis] - low->acc_g[axis];
    if (range_g <= widest_g) continue;
    widest_g = range_g;
    sensitivity = (course[static_cast<std::size_t>(high - record.begin())] -
                   course[static_cast<std::size_t>(low - record.begin())]) /
                  range_g;
  }
  return sensitivity;
}

}  // namespace

double told_amplitude(const SlowFinding& finding, const SlowModel& model) {
  if (!finding.term) return 0;
  if (finding.effect == "g_sensitivity" && finding.law == "measured") {
    return sensitivity_where_it_tilted(finding, model);
  }
  const bool aging = finding.effect == "aging_drift" && finding.law != "linear";
  if (!aging && finding.effect != "condensation_step") return 0;
  const auto& record = model.track().record;
  const auto course =
      rig::drift_over(*finding.term->law, finding.term->values, model.bias(), record);
  if (aging) {
    const double hours = (record.back().t_s - record.front().t_s) / 3600;
    return (course.back() - course.front()) / hours * 1000;
  }
  return *std::max_element(course.begin(), course.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

}  // namespace gyrocal
