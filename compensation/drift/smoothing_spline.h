#pragma once

#include <Eigen/Core>
#include <optional>

#include "compensation/values/error.h"

namespace gyrocal {

/// Natural cubic spline through smoothed values at the knots.
struct Spline {
  Eigen::VectorXd knots;   ///< n, strictly rising
  Eigen::VectorXd values;  ///< n
  Eigen::VectorXd second;  ///< n second derivatives, 0 at both ends
  double lambda = 0;       ///< smoothing parameter in force
  double trace = 0;        ///< of the smoother: its effective number of parameters, 2 ... n
};

/// Minimises sum w_i (y_i - f(x_i))^2 + lambda * integral f''^2 (Reinsch 1967). Without a lambda it
/// is chosen by generalized cross-validation (trace weighed 1.4), whose trace comes from the
/// central bands of the inverse (Hutchinson and de Hoog 1985): O(n) for each lambda tried.
/// @param x, y     n >= 4 values, finite, x strictly rising.
/// @param weights  empty (all 1) or n positive values.
/// @return too_few_points, not_finite.
[[nodiscard]] Result<Spline> fit_smoothing_spline(const Eigen::Ref<const Eigen::VectorXd>& x,
                                                  const Eigen::Ref<const Eigen::VectorXd>& y,
                                                  const Eigen::VectorXd& weights = {},
                                                  std::optional<double> lambda = {});

/// Straight lines outside the knots, as a natural spline has them.
[[nodiscard]] double value_at(const Spline& spline, double x);

}  // namespace gyrocal
