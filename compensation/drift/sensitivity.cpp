#include "compensation/drift/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "compensation/drift/student_t.h"
#include "compensation/values/records.h"

namespace gyrocal {
namespace {

constexpr double band_probability = 0.95;

Result<Eigen::VectorXd> fitted(Method method, const DriftSeries& series,
                               const MethodSettings& settings) {
  const auto curve = fit_method(method, series, settings);
  if (!curve) return tl::unexpected(curve.error());
  return series.temperature_c().unaryExpr([&](double t) { return curve->at({t}); }).eval();
}

}  // namespace

Result<Eigen::MatrixXd> sensitivity(Method method, const DriftSeries& series,
                                    const MethodSettings& settings) {
  if (const auto design = polynomial_design(method, series)) {
    return polynomial_hat_matrix(design->x, design->degree, design->weight);
  }
  const Eigen::Index n = series.drift_dps.size();
  const double step = 1e-4 * std::max(series.drift_dps.cwiseAbs().maxCoeff(), 1e-6);
  Eigen::MatrixXd jacobian(n, n);
  DriftSeries moved = series;
  for (Eigen::Index j = 0; j < n; ++j) {
    moved.drift_dps(j) = series.drift_dps(j) + step;
    const auto above = fitted(method, moved, settings);
    moved.drift_dps(j) = series.drift_dps(j) - step;
    const auto below = fitted(method, moved, settings);
    moved.drift_dps(j) = series.drift_dps(j);
    if (!above) return tl::unexpected(above.error());
    if (!below) return tl::unexpected(below.error());
    jacobian.col(j) = (*above - *below) / (2 * step);
  }
  return jacobian;
}

std::vector<double> prediction_band(const Eigen::MatrixXd& jacobian,
                                    const Eigen::VectorXd& residual_dps,
                                    const Eigen::VectorXd& weight) {
  const Eigen::Index n = residual_dps.size();
  const Eigen::VectorXd w = weight.size() == 0 ? Eigen::VectorXd::Ones(n).eval() : weight;
  const double degrees = static_cast<double>(n) - jacobian.trace();
  std::vector<double> band(static_cast<std::size_t>(n), missing);
  if (degrees < 1e-6) return band;
  const double variance = residual_dps.cwiseAbs2().dot(w) / degrees;
  const double t = student_t_two_sided(band_probability, degrees);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double spread =
        1 / w(i) + (jacobian.row(i).transpose().cwiseAbs2().array() / w.array()).sum();
    band[static_cast<std::size_t>(i)] = t * std::sqrt(variance * spread);
  }
  return band;
}

}  // namespace gyrocal
