#pragma once

#include <Eigen/Core>

#include "compensation/values/error.h"

namespace gyrocal {

/// p(x) = sum_j coefficients(j) * ((x - centre) / scale)^j. Centred and scaled, so that a fit of
/// degree 5 over an axis that runs to 100 stays well conditioned.
struct Polynomial {
  double centre = 0;
  double scale = 1;              ///< never 0
  Eigen::VectorXd coefficients;  ///< ascending powers, degree + 1 values
};

[[nodiscard]] double value_at(const Polynomial& polynomial, double x);

/// Least squares by QR with column pivoting; centre and scale are the mean and the standard
/// deviation of x (MATLAB's polyfit with [p,S,mu]).
/// @param x, y     n values each, finite.
/// @param degree   >= 0.
/// @param weights  empty, or n positive weights (1 / variance) of the squared residuals.
/// @return too_few_points when the x carry fewer than degree + 1 different values; not_finite.
[[nodiscard]] Result<Polynomial> fit_polynomial(const Eigen::Ref<const Eigen::VectorXd>& x,
                                                const Eigen::Ref<const Eigen::VectorXd>& y,
                                                int degree, const Eigen::VectorXd& weights = {});

/// d fitted(i) / d y(j) of that fit, n x n: W^-1/2 Q Q' W^1/2 with Q from the QR of the weighted
/// powers. The same errors.
[[nodiscard]] Result<Eigen::MatrixXd> polynomial_hat_matrix(
    const Eigen::Ref<const Eigen::VectorXd>& x, int degree, const Eigen::VectorXd& weights = {});

}  // namespace gyrocal
