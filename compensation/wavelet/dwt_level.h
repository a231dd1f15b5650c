#pragma once

#include <cstddef>
#include <span>

#include "compensation/wavelet/boundary.h"
#include "compensation/wavelet/filter_bank.h"

namespace gyrocal {

/// One level down: both bands of `signal`, each of band_length() values. `low` and `high` do not
/// overlap `signal`.
void analyse_level(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                   std::span<double> low, std::span<double> high);

/// One level up: the first signal.size() values of the signal whose bands these are. An empty
/// `high` stands for zeros, an empty `low` likewise; one of them is given.
void synthesise_level(std::span<const double> low, std::span<const double> high,
                      const FilterBank& bank, Boundary boundary, std::span<double> signal);

}  // namespace gyrocal
