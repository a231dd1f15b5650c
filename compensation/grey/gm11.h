#pragma once

#include <Eigen/Core>

#include "compensation/values/error.h"

namespace gyrocal {

struct Gm11 {
  double a_per_step = 0;       ///< development coefficient [1/step]
  double b_dps = 0;            ///< grey input [deg/s]
  double first_index = 1;      ///< index of the first point
  double first_dps = 0;        ///< first point, kept as measured: x1(1) = x0(1)
  Eigen::VectorXd fitted_dps;  ///< n values; fitted_dps(0) == drift_dps(0)
};

/// Plain GM(1,1): x0(k) + a z1(k) = b, z1 the mean of neighbours in the 1-AGO series.
/// By QR, not the normal equations of Eq. (6): those square the condition number.
/// @param drift_dps  n zero-rate outputs [deg/s] in setpoint order; n >= 4, finite, >= 0 (Eq. (3)).
/// @return the model; too_few_points, not_finite, out_of_range (translate first). O(n).
/// Source: paper Eqs. (3)-(10). Held to tests/golden/paper_table1.json.
[[nodiscard]] Result<Gm11> fit_gm11(const Eigen::Ref<const Eigen::VectorXd>& drift_dps);

/// The same where setpoints are missing: point i stands at index(i) of the plan (strictly rising,
/// 1 = first setpoint), and a point after a hole is accumulated over the whole step,
/// x1(k_i) = x1(k_{i-1}) + (k_i - k_{i-1}) x0(k_i). With index 1, 2, ..., n it is the plain model;
/// with holes it is what leave-one-out needs, on an axis that does not move.
[[nodiscard]] Result<Gm11> fit_gm11(const Eigen::Ref<const Eigen::VectorXd>& index,
                                    const Eigen::Ref<const Eigen::VectorXd>& drift_dps);

/// The accumulated series x1 of a drift at the given index: O(n).
[[nodiscard]] Eigen::VectorXd accumulated(const Eigen::Ref<const Eigen::VectorXd>& index,
                                          const Eigen::Ref<const Eigen::VectorXd>& drift_dps);

/// Eq. (9) for any real k [deg/s times step]; finite for a = 0 too.
[[nodiscard]] double accumulated_at(const Gm11& model, double k);

/// Eq. (10) for any real k: x1(k) - x1(k - 1). Below the second setpoint, where k - 1 lies before
/// the first point, the straight line from the kept first value to x0(first_index + 1).
[[nodiscard]] double drift_at(const Gm11& model, double k);

/// 1, 2, ..., n.
[[nodiscard]] Eigen::VectorXd plain_index(Eigen::Index n);

}  // namespace gyrocal
