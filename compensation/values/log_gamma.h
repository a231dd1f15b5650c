#pragma once

#include <math.h>  // lgamma_r is not in <cmath>

namespace gyrocal {

/// Logarithm of the gamma function of x > 0, for any number of threads at once: std::lgamma writes
/// the global signgam.
[[nodiscard]] inline double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace gyrocal
