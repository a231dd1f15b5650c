#pragma once

#include <Eigen/Core>

namespace gyrocal {

/// A linear model with noise of a given shape, its coefficients and white level profiled out.
struct ProfiledLevel {
  double log_likelihood = -1e300;  ///< [nat]
  double white_variance = 0;
};

/// @param white  n x (p + 1): the design and, last, y, as the noise whitens them.
/// @param logs   sum of the logarithms of the innovations' variances, in units of the white one's.
[[nodiscard]] ProfiledLevel profile_level(const Eigen::MatrixXd& white, double logs);

}  // namespace gyrocal
