#pragma once

#include <array>

#include "compensation/drift/curve.h"

namespace gyrocal {

/// drift = sum c(j) (T - reference)^j, j = 0 ... 3: what PX4 and ArduPilot evaluate.
struct Cubic {
  double reference_c = 0;
  double min_c = 0, max_c = 0;  ///< range in which it was fitted
  std::array<double, 4> dps{};  ///< c(j) [deg/s / K^j]
};

/// Least squares on 401 even temperatures over the setpoints' range, so that a grey model, a spline
/// or a polynomial of degree 5 becomes the nearest cubic. What is lost is the caller's to show.
[[nodiscard]] Result<Cubic> nearest_cubic(const DriftCurve& curve, double reference_c);

[[nodiscard]] double value_at(const Cubic& cubic, double temperature_c);

}  // namespace gyrocal
