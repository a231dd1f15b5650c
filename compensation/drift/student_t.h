#pragma once

namespace gyrocal {

/// The t with P(|T| < t) = `probability` for Student's t with `degrees` (> 0, real) of freedom.
/// Bisection on the regularised incomplete beta function; absolute error below 1e-9 for
/// degrees >= 1 and probability <= 0.999.
[[nodiscard]] double student_t_two_sided(double probability, double degrees);

}  // namespace gyrocal
