#include "compensation/drift/left_over.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compensation/values/assert.h"

namespace gyrocal {

LeftOver left_over(std::span<const double> rate_dps) {
  GYROCAL_ASSERT(!rate_dps.empty());
  const auto n = static_cast<double>(rate_dps.size());
  LeftOver result;
  result.mean_dps = std::accumulate(rate_dps.begin(), rate_dps.end(), 0.0) / n;
  double squares = 0;
  double spread = 0;
  for (const double rate : rate_dps) {
    squares += rate * rate;
    spread += (rate - result.mean_dps) * (rate - result.mean_dps);
    result.max_dps = std::max(result.max_dps, std::abs(rate));
  }
  result.rms_dps = std::sqrt(squares / n);
  result.standard_deviation_dps = n > 1 ? std::sqrt(spread / (n - 1)) : 0;
  return result;
}

std::size_t rows_of_training(const FittedModel& model, std::span<const double> temperature_c,
                             std::span<const double> rate_dps) {
  GYROCAL_ASSERT(temperature_c.size() == rate_dps.size());
  constexpr double same = 1e-9;
  const std::size_t points = std::min(model.setpoint_c.size(), model.measured_dps.size());
  std::size_t rows = 0;
  for (std::size_t i = 0; i < rate_dps.size(); ++i) {
    for (std::size_t k = 0; k < points; ++k) {
      if (std::abs(temperature_c[i] - model.setpoint_c[k]) < same &&
          std::abs(rate_dps[i] - model.measured_dps[k]) < same) {
        ++rows;
        break;
      }
    }
  }
  return rows;
}

}  // namespace gyrocal
