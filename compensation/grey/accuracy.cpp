#include "compensation/grey/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compensation/values/assert.h"

namespace gyrocal {

Accuracy accuracy(std::span<const double> measured_dps, std::span<const double> fitted_dps) {
  GYROCAL_ASSERT(!measured_dps.empty() && measured_dps.size() == fitted_dps.size());
  double squares = 0;
  double sizes = 0;
  Accuracy result;
  for (std::size_t i = 0; i < measured_dps.size(); ++i) {
    const double error = measured_dps[i] - fitted_dps[i];
    squares += error * error;
    sizes += std::abs(error);
    result.max = std::max(result.max, std::abs(error));
  }
  const auto n = static_cast<double>(measured_dps.size());
  result.rmse_n = std::sqrt(squares / n);
  result.rmse_n_minus_1 =
      n > 1 ? std::sqrt(squares / (n - 1)) : std::numeric_limits<double>::quiet_NaN();
  result.mae = sizes / n;
  return result;
}

}  // namespace gyrocal
