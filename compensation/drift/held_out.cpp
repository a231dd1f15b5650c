#include "compensation/drift/held_out.h"

#include <Eigen/LU>
#include <algorithm>

namespace gyrocal {
namespace {

DriftSeries without(const DriftSeries& whole, std::size_t point, std::size_t neighbours) {
  DriftSeries rest;
  rest.axis = whole.axis;
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < whole.position.size(); ++i) {
    const bool held_out = i + neighbours >= point && i <= point + neighbours;
    if (held_out) continue;
    rest.position.push_back(whole.position[i]);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  rest.drift_dps = whole.drift_dps(kept);
  if (whole.weight.size() != 0) rest.weight = whole.weight(kept);
  return rest;
}

/// By the hat matrix H of the whole fit instead of n fits: the errors of a least-squares fit that
/// lacked a block B are (I - H_BB)^-1 e_B, e the residuals of the fit that had it (Cook and
/// Weisberg 1982, Residuals and Influence in Regression).
std::vector<double> predictions_by_hat_matrix(const Eigen::MatrixXd& hat,
                                              const Eigen::VectorXd& measured,
                                              Eigen::Index neighbours) {
  const Eigen::Index n = measured.size();
  const Eigen::VectorXd residual = measured - hat * measured;
  std::vector<double> predictions;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(i - neighbours, 0);
    const Eigen::Index size = std::min(i + neighbours, n - 1) - first + 1;
    const Eigen::MatrixXd left =
        Eigen::MatrixXd::Identity(size, size) - hat.block(first, first, size, size);
    const Eigen::VectorXd error = left.partialPivLu().solve(residual.segment(first, size));
    predictions.push_back(measured(i) - error(i - first));
  }
  return predictions;
}

/// Whether a fit without the largest block is still determined with room to spare.
bool determined_without_block(const PolynomialDesign& design, std::size_t neighbours) {
  return design.x.size() - static_cast<Eigen::Index>(2 * neighbours + 1) > design.degree;
}

}  // namespace

Result<std::vector<double>> held_out_predictions(Method method, const DriftSeries& whole,
                                                 const MethodSettings& settings,
                                                 std::size_t neighbours) {
  const auto design = polynomial_design(method, whole);
  if (design && determined_without_block(*design, neighbours)) {
    const auto hat = polynomial_hat_matrix(design->x, design->degree, design->weight);
    if (!hat) return tl::unexpected(hat.error());
    return predictions_by_hat_matrix(*hat, whole.drift_dps, static_cast<Eigen::Index>(neighbours));
  }
  std::vector<double> predictions;
  predictions.reserve(whole.position.size());
  for (std::size_t i = 0; i < whole.position.size(); ++i) {
    const auto curve = fit_method(method, without(whole, i, neighbours), settings);
    if (!curve) return tl::unexpected(curve.error());
    predictions.push_back(curve->at({whole.axis.setpoints_c[whole.position[i]]}));
  }
  return predictions;
}

}  // namespace gyrocal
