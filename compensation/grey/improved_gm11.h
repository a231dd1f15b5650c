#pragma once

#include "compensation/grey/gm11.h"
#include "compensation/grey/polynomial.h"

namespace gyrocal {

inline constexpr int improved_degree_paper = 5;  ///< what reproduces the paper's Table 2
inline constexpr int improved_degree_max = 5;

struct ImprovedGm11 {
  Gm11 base;
  Polynomial residual;         ///< of the 1-AGO series, in xhat1 [deg/s times step]
  Eigen::VectorXd fitted_dps;  ///< n values; fitted_dps(0) == drift_dps(0)
};

/// Improved GM(1,1): the residual eps(k) = x1(k) - xhat1(k) of the 1-AGO series, first point
/// included (its residual is 0), as a polynomial of xhat1(k) by QR; added back to xhat1 and
/// differenced; the first value is kept.
/// @param drift_dps  as for fit_gm11.
/// @param degree     0...5; the paper names none, 5 reproduces its figures.
/// @return as fit_gm11; too_few_points with fewer than degree + 1 zero drifts, out_of_range for
///         another degree. Close to degree + 1 points the polynomial copies the noise; analyse()
///         warns of it.
/// Source: paper Eqs. (11)-(14). Held to tests/golden/paper_table1.json.
[[nodiscard]] Result<ImprovedGm11> fit_improved_gm11(
    const Eigen::Ref<const Eigen::VectorXd>& drift_dps, int degree = improved_degree_paper);

/// The same on an index with holes, see fit_gm11.
[[nodiscard]] Result<ImprovedGm11> fit_improved_gm11(
    const Eigen::Ref<const Eigen::VectorXd>& index,
    const Eigen::Ref<const Eigen::VectorXd>& drift_dps, int degree);

/// Drift at any real k, as drift_at(Gm11) but with the residual added back to xhat1.
[[nodiscard]] double drift_at(const ImprovedGm11& model, double k);

}  // namespace gyrocal
