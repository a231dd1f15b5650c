#pragma once

#include <span>
#include <vector>

namespace gyrocal {

/// Median of |x|, exact; the mean of the middle two where their number is even. `values` are finite
/// and at least one. `scratch` is overwritten. O(n) on average.
[[nodiscard]] double median_magnitude(std::span<const double> values, std::vector<double>& scratch);

}  // namespace gyrocal
