#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "compensation/discrepancy/slow_noise.h"

namespace gyrocal {

/// What flicker and walk must have been doing, bin by bin, given residuals at some of them.
struct DriftEstimate {
  Eigen::VectorXd mean_dps;
  Eigen::VectorXd variance_dps2;
};

/// One more relaxing part of the drift: the slow side of a telegraph, say.
struct RelaxingPart {
  double tau_s = 0;
  double variance_dps2 = 0;
};

/// Kalman filter forward, Rauch-Tung-Striebel backward.
/// @param grid  all bins wanted; weight_s == 0 where there is no residual to look at.
/// @param residual_dps  measured minus drift-free prediction; ignored where weight is 0.
/// @param white_sd_dps  of one second.
[[nodiscard]] DriftEstimate estimate_drift(const SlowGrid& grid, const SlowNoiseShape& shape,
                                           double white_sd_dps, std::span<const RelaxingPart> parts,
                                           const Eigen::VectorXd& residual_dps);

}  // namespace gyrocal
