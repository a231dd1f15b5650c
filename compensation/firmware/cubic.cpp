#include "compensation/firmware/cubic.h"

namespace gyrocal {
namespace {

/// Coefficients of p around another reference, by repeated synthetic division (Taylor shift).
std::array<double, 4> shifted(const Polynomial& p, double reference_c) {
  std::array<double, 4> c{};
  double power = 1;
  for (Eigen::Index j = 0; j < p.coefficients.size(); ++j) {
    c[static_cast<std::size_t>(j)] = p.coefficients(j) / power;  // now in (T - centre)^j
    power *= p.scale;
  }
  const double move = reference_c - p.centre;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 2 + 1; j-- > i;) c[j] += move * c[j + 1];
  }
  return c;
}

}  // namespace

Result<Cubic> nearest_cubic(const DriftCurve& curve, double reference_c) {
  constexpr Eigen::Index points = 401;
  Cubic cubic;
  cubic.reference_c = reference_c;
  cubic.min_c = curve.axis.setpoints_c.front();
  cubic.max_c = curve.axis.setpoints_c.back();
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(points, cubic.min_c, cubic.max_c);
  const Eigen::VectorXd drift = t.unaryExpr([&](double x) { return curve.at({x}); });
  const auto fitted = fit_polynomial(t, drift, 3);
  if (!fitted) return tl::unexpected(fitted.error());
  cubic.dps = shifted(*fitted, reference_c);
  return cubic;
}

double value_at(const Cubic& cubic, double temperature_c) {
  const double x = temperature_c - cubic.reference_c;
  return cubic.dps[0] + x * (cubic.dps[1] + x * (cubic.dps[2] + x * cubic.dps[3]));
}

}  // namespace gyrocal
