#pragma once
#include <cstddef>
#include <vector>

#include "tests/hidden_effects/random.h"

namespace hidden {

/// Flicker noise on a uniform grid, one-sided S(f) = B^2/(2 pi f) below half the grid rate:
/// Kasdin's fractional difference of order 1/2 applied to white noise, after a prehistory long
/// enough that the start is no special moment.
/// Source: Kasdin 1995, "Discrete simulation of colored noise", recursion h_k = h_(k-1)(k-1/2)/k.
/// @param b_dps  bias instability B [deg/s]. O(n log n).
std::vector<double> flicker_noise(std::size_t n, double b_dps, Random& random);

/// Rate random walk, starting at zero. S(f) = K^2/(2 pi f)^2 (two-sided K^2, as IEEE 952).
/// @param k_dps_per_root_s  K [deg/s/sqrt(s)]; step_s the grid spacing [s].
std::vector<double> random_walk(std::size_t n, double k_dps_per_root_s, double step_s,
                                Random& random);

}  // namespace hidden
