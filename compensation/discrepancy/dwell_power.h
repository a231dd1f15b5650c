#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gyrocal {

/// |FFT|^2 of a dwell, from 0 to below the folding frequency. Samples that did not arrive count as
/// the mean, as do those beyond the first `samples` and the padding up to `length`.
/// @param seq     the numbers of y's samples, ascending.
/// @param length  of the transform, even, at least `samples`.
/// @return length / 2 values [unit of y, squared].
[[nodiscard]] std::vector<double> dwell_power(std::span<const double> y,
                                              std::span<const std::int64_t> seq, double mean,
                                              std::size_t samples, std::size_t length);

}  // namespace gyrocal
