#pragma once

#include <string>
#include <vector>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// What an effect-blind smooth curve over one driver would still explain.
struct SmoothGain {
  std::string driver;  ///< "die temperature", "direction", "heating rate", ...
  std::string unit;
  double nats = 0;            ///< gain in marginal likelihood: the curve's freedom is paid for
  double rms_dps = 0;         ///< size of the curve over the record
  double peak_dps = 0;        ///< largest distance from its mean
  double peak_at = 0;         ///< where, in the driver's unit
  std::vector<double> curve;  ///< course at the track's instants [deg/s]
};

/// Every driver, best first: cosines over the driver's range with a common variance that is
/// fitted, against the present model with all noise free; beside the curve the noise may be less.
/// Source: discrepancy_methods.md section 2, steps 5 and 7.
[[nodiscard]] std::vector<SmoothGain> smooth_gains(const SlowModel& model);

}  // namespace gyrocal
