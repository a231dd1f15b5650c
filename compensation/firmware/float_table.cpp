#include "compensation/firmware/float_table.h"

#include <cmath>

namespace gyrocal {
namespace {

/// Whether a straight line over [low, high] keeps to the curve, probed at the quarters.
bool straight_enough(const DriftCurve& curve, double low, double high, double tolerance_dps) {
  const double at_low = curve.at({low});
  const double at_high = curve.at({high});
  for (const double part : {0.25, 0.5, 0.75}) {
    const double line = at_low + part * (at_high - at_low);
    if (std::abs(curve.at({low + part * (high - low)}) - line) > tolerance_dps) return false;
  }
  return true;
}

int parts_of_step(const DriftCurve& curve, double low, double high, double tolerance_dps) {
  constexpr int parts_max = 32;
  for (int parts = 1; parts < parts_max; parts *= 2) {
    const double width = (high - low) / parts;
    bool straight = true;
    for (int i = 0; i < parts && straight; ++i) {
      straight = straight_enough(curve, low + i * width, low + (i + 1) * width, tolerance_dps);
    }
    if (straight) return parts;
  }
  return parts_max;
}

template <class Real>
Real interpolated(const FloatTable& table, Real at) {
  const auto t = [&](std::size_t i) { return static_cast<Real>(table.temperature_c[i]); };
  const auto d = [&](std::size_t i) { return static_cast<Real>(table.drift_dps[i]); };
  const std::size_t last = table.temperature_c.size() - 1;
  if (!(at > t(0))) return d(0);
  if (at >= t(last)) return d(last);
  std::size_t i = 0;
  while (at >= t(i + 1)) ++i;
  return d(i) + (d(i + 1) - d(i)) * ((at - t(i)) / (t(i + 1) - t(i)));
}

}  // namespace

FloatTable tabulated(const DriftCurve& curve, double tolerance_dps) {
  FloatTable table;
  const auto add = [&](double temperature_c) {
    const auto rounded = static_cast<float>(temperature_c);
    if (!table.temperature_c.empty() && rounded <= table.temperature_c.back()) return;
    table.temperature_c.push_back(rounded);
    table.drift_dps.push_back(static_cast<float>(curve.at({temperature_c})));
  };
  const auto& setpoints = curve.axis.setpoints_c;
  for (std::size_t i = 0; i + 1 < setpoints.size(); ++i) {
    const double low = setpoints[i];
    const double high = setpoints[i + 1];
    const int parts = parts_of_step(curve, low, high, tolerance_dps);
    for (int part = 0; part < parts; ++part) add(low + (high - low) * part / parts);
  }
  add(setpoints.back());
  return table;
}

float value_at(const FloatTable& table, float temperature_c) {
  return interpolated(table, temperature_c);
}

double value_at(const FloatTable& table, double temperature_c) {
  return interpolated(table, temperature_c);
}

}  // namespace gyrocal
