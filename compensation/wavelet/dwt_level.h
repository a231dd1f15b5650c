#pragma once

#include <cstddef>
#include <span>

#include "compensation/wavelet/boundary.h"
#include "compensation/wavelet/filter_bank.h"

namespace gyrocal {

/// Length of each band one level down: ceil(n/2) for periodization, floor((n + taps - 1)/2) else.
[[nodiscard]] std::size_t band_length(std::size_t signal_length, std::size_t taps,
                                      Boundary boundary);

/// Index of the sample under the filter's first tap at output 0 (0 or negative); output o starts
/// 2o further on.
[[nodiscard]] std::ptrdiff_t first_index(std::size_t taps, Boundary boundary);

/// One level down: both bands of `signal`, each of band_length() values. `low` and `high` do not
/// overlap `signal`.
void analyse_level(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                   std::span<double> low, std::span<double> high);

/// One level up: the first signal.size() values of the signal whose bands these are. An empty
/// `high` stands for zeros, an empty `low` likewise; one of them is given.
void synthesise_level(std::span<const double> low, std::span<const double> high,
                      const FilterBank& bank, Boundary boundary, std::span<double> signal);

}  // namespace gyrocal
