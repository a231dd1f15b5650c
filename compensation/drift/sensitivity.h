#pragma once

#include "compensation/drift/methods.h"

namespace gyrocal {

/// d fitted(i) / d measured(j), n x n: the hat matrix of a linear method, its linearisation for a
/// grey one (by central differences, as for a spline). A spline's lambda and a
/// grey translation count as given.
[[nodiscard]] Result<Eigen::MatrixXd> sensitivity(Method method, const DriftSeries& series,
                                                  const MethodSettings& settings);

/// Half widths of the 95 % band for a new zero drift at each setpoint [deg/s]:
/// t * s * sqrt(1/w_i + sum_j J_ij^2 / w_j), s^2 = sum w e^2 / (n - tr J). NaN when n <= tr J.
/// It covers noise, not a wrong shape: read it beside the held-out error.
/// @param residual_dps  n residuals of the training fit.
[[nodiscard]] std::vector<double> prediction_band(const Eigen::MatrixXd& jacobian,
                                                  const Eigen::VectorXd& residual_dps,
                                                  const Eigen::VectorXd& weight);

}  // namespace gyrocal
