#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// The Allan deviation at one averaging time.
struct AllanPoint {
  std::size_t averaged;  ///< samples averaged, m
  double tau_s;          ///< m / sample rate
  double deviation;      ///< in the unit of the rate
  double deviation_low;  ///< 95 % confidence interval
  double deviation_high;
  double degrees_of_freedom;  ///< of the chi-squared distribution of deviation^2; not whole
};

/// Averaging factors 1, ..., floor(n / 2), `per_decade` to a decade where they differ.
[[nodiscard]] std::vector<std::size_t> allan_factors(std::size_t samples, int per_decade);

/// Stretches of a rate without a hole in time, each with a mean of its own: the dwells of a
/// session, or what lost samples left of one dwell.
using RatePieces = std::span<const std::span<const double>>;

/// Overlapping Allan deviation of a rate sampled evenly, over all pieces that are long enough:
///   sigma^2(m) = sum_j (s(j+2m) - 2 s(j+m) + s(j))^2 / (2 m^2 terms),
/// s the running sum of a piece; a piece of n samples gives n - 2m + 1 terms. The degrees of
/// freedom are those of the power law whose slope the deviation has at m: white rate noise, flicker
/// or random walk. Source: Riley, NIST SP 1065, Eq. (11) and Table 5.
/// @param factors  each from 1 to half the longest piece, rising.
/// @return a point each; too_few_points (no piece of 2 samples), not_finite, out_of_range. O(n) a
///         point.
[[nodiscard]] Result<std::vector<AllanPoint>> overlapping_allan(
    RatePieces pieces, double sample_rate_hz, std::span<const std::size_t> factors);

/// The same without the confidence intervals, which cost more than the deviations: missing.
[[nodiscard]] Result<std::vector<AllanPoint>> allan_without_intervals(
    RatePieces pieces, double sample_rate_hz, std::span<const std::size_t> factors);

/// The same as overlapping_allan for one piece.
[[nodiscard]] Result<std::vector<AllanPoint>> overlapping_allan(
    std::span<const double> rate, double sample_rate_hz, std::span<const std::size_t> factors);

/// Samples of the longest piece.
[[nodiscard]] std::size_t longest_of(RatePieces pieces);

}  // namespace gyrocal
