#pragma once

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// One row a setpoint, in rising order, from dwells in any order: a sweep up and down or a shuffled
/// one visits a setpoint more than once, and models want each once. Zero drifts of the same
/// setpoint are averaged, weighted by 1 / standard error^2 where those are known.
struct SetpointMeans {
  DriftTable table;
  std::vector<double> standard_error_dps;  ///< of the means; empty where none were given
};

/// @param dwells              setpoints and zero drifts in the order measured.
/// @param standard_error_dps  empty or one for each dwell, positive.
/// @return bad_input for lengths that differ or a number that is not finite.
[[nodiscard]] Result<SetpointMeans> setpoint_means(
    const DriftTable& dwells, const std::vector<double>& standard_error_dps = {});

}  // namespace gyrocal
