#pragma once

#include <span>

#include "compensation/drift/model.h"

namespace gyrocal {

/// What a rate of a resting gyro holds: what compensation is meant to take away.
struct LeftOver {
  double mean_dps = 0;
  double standard_deviation_dps = 0;  ///< divisor n - 1; 0 for one value
  double rms_dps = 0;
  double max_dps = 0;  ///< largest |value|
};

/// @param rate_dps  n >= 1 values.
[[nodiscard]] LeftOver left_over(std::span<const double> rate_dps);

/// How many of the rows are points the model was fitted to (same setpoint, same zero drift to
/// 1e-9): on those "after" is a training error.
/// @param temperature_c, rate_dps  n values each.
[[nodiscard]] std::size_t rows_of_training(const FittedModel& model,
                                           std::span<const double> temperature_c,
                                           std::span<const double> rate_dps);

}  // namespace gyrocal
