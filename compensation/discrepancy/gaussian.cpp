#include "compensation/discrepancy/gaussian.h"

#include <cmath>
#include <numbers>

namespace gyrocal {

double upper_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normal_quantile(double share) {
  double low = -40, high = 40;
  while (high - low > 1e-10) {
    const double middle = (low + high) / 2;
    (upper_tail(-middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace gyrocal
