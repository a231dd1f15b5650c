#pragma once

#include <cstddef>
#include <span>

#include "compensation/drift/allan.h"
#include "compensation/drift/allan_likelihood.h"
#include "compensation/values/error.h"

namespace gyrocal {

/// A noise coefficient with its 95 % interval. Not resolved: the data do not ask for this noise;
/// value and low are 0 and high is its 95 % upper limit.
struct NoiseCoefficient {
  double value = 0;
  double low = 0;
  double high = 0;
  bool resolved = false;
};

/// Noise of a rate (unit U, such as deg/s) as a sum over the averaging time tau:
///   Allan variance = N^2 / tau + (2 ln 2 / pi) B^2 + K^2 tau / 3 + that of correlated noise.
struct AllanNoise {
  NoiseCoefficient angle_random_walk;  ///< N [U/sqrt(Hz)]: white rate noise
  NoiseCoefficient bias_instability;   ///< B [U]: flicker; the floor of the deviation is 0.664 B
  NoiseCoefficient rate_random_walk;   ///< K [U/sqrt(s)]
  NoiseCoefficient correlated;         ///< deviation [U] of a first-order Gauss-Markov process
  double correlation_time_s = 0;       ///< of that; 0 if not resolved
  std::size_t fitted_from = 1;  ///< averaging factor from which the sum describes the data; below
                                ///< it the noise is of another kind (filtered, quantised)
  bool described = true;        ///< false: not even the longest averages agree with such a sum
  double sample_rate_hz = 1;
  NoiseModel model;  ///< the same in samples instead of seconds

  /// The fitted Allan variance [U^2] at an averaging time, extrapolated if need be.
  [[nodiscard]] double variance_at(double tau_s) const;
};

/// Fits the sum to the overlapping Allan variances at octaves up to n/4. Each variance is taken as
/// chi-squared with a share of its degrees of freedom (quasi-likelihood: neighbouring octaves share
/// data); a kind of noise stays if it raises twice the log likelihood by more than 8 a parameter;
/// intervals are profile likelihoods. Short averages are left out, octave by octave, while the sum
/// does not describe them (0.1 % level).
/// @param pieces  sampled evenly; the longest holds n >= 32 samples, all finite. A constant rate
/// has
///                no noise: all 0.
/// @return the coefficients; too_few_points, not_finite, out_of_range (sample rate).
[[nodiscard]] Result<AllanNoise> fit_allan_noise(RatePieces pieces, double sample_rate_hz);

/// The same for one piece.
[[nodiscard]] Result<AllanNoise> fit_allan_noise(std::span<const double> rate,
                                                 double sample_rate_hz);

}  // namespace gyrocal
