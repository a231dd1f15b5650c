#pragma once

#include <Eigen/Core>
#include <functional>

namespace gyrocal {

struct SimplexResult {
  Eigen::VectorXd at;
  double value = 0;
  int evaluations = 0;
};

/// Nelder-Mead minimisation of a smooth function of a few variables, deterministic. Stops when the
/// values at the corners differ by less than `tolerance` or after `evaluations_max` calls.
/// @param start  d >= 1 variables.  @param step  edge of the first simplex, per variable.
/// Source: Nelder & Mead, Computer Journal 7 (1965) 308.
[[nodiscard]] SimplexResult minimise(const std::function<double(const Eigen::VectorXd&)>& function,
                                     const Eigen::VectorXd& start, const Eigen::VectorXd& step,
                                     double tolerance, int evaluations_max);

}  // namespace gyrocal
