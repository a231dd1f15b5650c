#pragma once

#include <vector>

#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// The grey index is no temperature: it counts setpoints, 1 ... n. Between setpoints it is linear,
/// so an uneven list (the paper's steps are 2 and 3 K) bends the axis.
struct IndexAxis {
  std::vector<double> setpoints_c;  ///< at least 2, finite, strictly rising
  bool operator==(const IndexAxis&) const = default;
};

/// @return out_of_range (first pair that does not rise, by its numbers), not_finite,
///         too_few_points.
[[nodiscard]] Result<IndexAxis> index_axis(std::vector<double> setpoints_c);

/// k(T), continuous; setpoint i (from 0) has k = i + 1 exactly. Outside the list the first or the
/// last step is continued: the caller decides whether that is allowed.
[[nodiscard]] double index_at(const IndexAxis& axis, Celsius temperature);

/// The inverse, T(k).
[[nodiscard]] Celsius temperature_at(const IndexAxis& axis, double k);

[[nodiscard]] bool covers(const IndexAxis& axis, Celsius temperature);

}  // namespace gyrocal
