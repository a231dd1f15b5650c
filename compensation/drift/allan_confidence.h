#pragma once

#include <cstddef>

namespace gyrocal {

/// Power laws of a rate's noise, by the slope of log(Allan variance) over log(averaging time):
/// -1, 0 and +1.
enum class RateNoise { white, flicker, random_walk };

/// The power law nearest to a slope.
[[nodiscard]] RateNoise noise_of_slope(double variance_slope);

/// Degrees of freedom of the overlapping Allan variance of n rate samples at averaging factor m;
/// at least 1. Source: Riley, NIST SP 1065, Table 5 (N = n + 1 phase points).
[[nodiscard]] double allan_degrees_of_freedom(std::size_t samples, std::size_t averaged,
                                              RateNoise noise);

/// The x below which a chi-squared variable stays with that probability. Relative error < 1e-9.
/// @param degrees_of_freedom  > 0   @param probability  in (0, 1)
[[nodiscard]] double chi_squared_quantile(double degrees_of_freedom, double probability);

}  // namespace gyrocal
