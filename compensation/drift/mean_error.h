#pragma once

#include <span>

#include "compensation/values/error.h"

namespace gyrocal {

/// Standard error of the mean of a dwell from its own noise, however correlated: the Allan
/// deviation at an averaging time of the whole dwell, extrapolated by the noise that
/// fit_allan_noise() finds. For white noise that is sigma/sqrt(n); for noise with a memory it is
/// sqrt(1 + 2 sum of autocorrelations) times that; for flicker it does not fall with n.
/// The dwell shows its own slow noise only through a few long averages, so the result itself is
/// uncertain: about 10 % for white noise of 3000 samples, 30 % for noise with a memory of seconds.
/// @param rate  n samples of one dwell [any unit], evenly sampled, raw and not filtered (a filter
///              takes noise away only above its corner; the mean's error stays); n >= 32, finite.
/// @return in the unit of the rate, 0 for a constant series; errors of fit_allan_noise().
[[nodiscard]] Result<double> standard_error_of_mean(std::span<const double> rate,
                                                    double sample_rate_hz);

}  // namespace gyrocal
