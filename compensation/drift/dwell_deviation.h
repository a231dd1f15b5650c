#pragma once

#include <cstdint>
#include <vector>

#include "compensation/wavelet/denoise.h"

namespace gyrocal {

/// Dwells of a resting gyro at one temperature: white noise on a constant rate, rounded to counts.
struct WhiteDwells {
  int dwells = 25;
  int samples = 3000;
  double rate_dps = 4.2;
  double deviation_dps = 1.3102;  ///< of the rounded samples: the paper's raw deviation
  double lsb_per_dps = 4.13;
  std::uint64_t seed = 1;
};

/// Standard deviations of one dwell [deg/s], divisor n - 1, and how far the filter moves its mean.
struct DwellDeviation {
  double raw_dps = 0;
  double filtered_dps = 0;
  double mean_moved_dps = 0;  ///< |mean after - mean before|
};

/// Simulates the dwells and filters each. The same seed gives the same numbers on every machine.
/// @return one pair a dwell; the errors of Denoiser.
[[nodiscard]] Result<std::vector<DwellDeviation>> dwell_deviations(const WhiteDwells& dwells,
                                                                   const DenoiseSettings& settings);

}  // namespace gyrocal
