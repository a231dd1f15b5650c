#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gyrocal {

/// The middle one of the values in order, of an even number the upper of the two. O(n).
/// @param values  at least one.
[[nodiscard]] inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace gyrocal
