#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "compensation/values/error.h"

namespace gyrocal {

/// How a signal goes on beyond its ends. For the signal 1 2 3 4:
///   symmetric      .. 2 1 | 1 2 3 4 | 4 3 ..      zero      .. 0 0 | 1 2 3 4 | 0 0 ..
///   reflect        .. 3 2 | 1 2 3 4 | 3 2 ..      constant  .. 1 1 | 1 2 3 4 | 4 4 ..
///   periodic       .. 3 4 | 1 2 3 4 | 1 2 ..
///   periodization  as periodic (a signal of odd length has its last value doubled first), with the
///                  fewest coefficients: half the signal's length, rounded up.
/// Signals shorter than the filter are continued as often as needed.
enum class Boundary { symmetric, periodization, zero, constant, reflect, periodic };

inline constexpr Boundary all_boundaries[] = {Boundary::symmetric, Boundary::periodization,
                                              Boundary::zero,      Boundary::constant,
                                              Boundary::reflect,   Boundary::periodic};

[[nodiscard]] std::string_view name_of(Boundary boundary);

/// @return the mode of that name; unknown_name with the list of known names.
[[nodiscard]] Result<Boundary> find_boundary(std::string_view name);

/// The continued signal at any index, inside or outside. `signal` is not empty.
[[nodiscard]] double continued(std::span<const double> signal, std::ptrdiff_t index,
                               Boundary boundary);

}  // namespace gyrocal
