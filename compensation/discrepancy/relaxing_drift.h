#pragma once

#include "compensation/discrepancy/slow_noise.h"

namespace gyrocal {

/// The best log likelihood of y = design * coefficients + white noise + a walk that forgets (an
/// Ornstein-Uhlenbeck process), all fitted [nat]: Gaussian noise with the Lorentzian spectrum that
/// two-level switching has too. Exact, by a Kalman filter; O(n p) a trial, some hundred trials.
/// @param y  n values [deg/s].  @param design  n x p, full column rank.
[[nodiscard]] double relaxing_log_likelihood(const SlowGrid& grid, const Eigen::VectorXd& y,
                                             const Eigen::MatrixXd& design);

}  // namespace gyrocal
