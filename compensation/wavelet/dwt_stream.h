#pragma once

#include <cstddef>
#include <span>

#include "compensation/wavelet/boundary.h"
#include "compensation/wavelet/filter_bank.h"

namespace gyrocal {

/// Levels that are worth doing together: beyond, the approximation is a 64th of the signal.
inline constexpr int streamed_levels = 6;

/// Whether stream_levels() may be used: the signal outlasts the caches and its two ends do not
/// touch.
[[nodiscard]] bool worth_streaming(std::size_t signal_length, std::size_t taps);

/// The first levels of a decomposition in one pass over the signal. Level by level, a signal longer
/// than the caches goes through memory twice; here each approximation stays in the cache until the
/// next level has used it. The same numbers to the last bit.
/// @param details  cD_1 .. cD_k, k <= streamed_levels, of band_length() values each; `low` is cA_k.
void stream_levels(std::span<const double> signal, const FilterBank& bank, Boundary boundary,
                   std::span<const std::span<double>> details, std::span<double> low);

}  // namespace gyrocal
