#include "compensation/wavelet/median_magnitude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

using Values = std::vector<double>;

/// Of `values`, reordered: their middle, `below` more values being less than all of them.
double middle_of(std::span<double> values, std::size_t below, std::size_t number) {
  const auto at = static_cast<std::ptrdiff_t>(number / 2 - below);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  const double upper = values[static_cast<std::size_t>(at)];
  if (number % 2 != 0) return upper;
  return (upper + *std::max_element(values.begin(), values.begin() + at)) / 2;
}

struct Window {
  double low;
  double high;
};

/// Where a few of the values, evenly taken, expect the median: their order statistics 2.5
/// deviations to either side of the middle one.
Window likely_window(std::span<const double> values) {
  constexpr std::size_t taken = 99;
  constexpr std::size_t reach = 12;
  std::array<double, taken> some{};
  for (std::size_t i = 0; i < taken; ++i) some[i] = std::abs(values[i * values.size() / taken]);
  std::sort(some.begin(), some.end());
  return {some[taken / 2 - reach], some[taken / 2 + reach]};
}

/// The median, if it lies in the window. The values there are collected without a branch: which
/// side a value is on cannot be predicted, and a wrong guess costs more than ten values.
std::optional<double> median_within(const Window& window, std::span<const double> values,
                                    Values& scratch) {
  std::size_t below = 0;
  std::size_t inside = 0;
  for (const double value : values) {
    const double magnitude = std::abs(value);
    scratch[inside] = magnitude;
    below += static_cast<std::size_t>(magnitude < window.low);
    inside += static_cast<std::size_t>((magnitude >= window.low) & (magnitude <= window.high));
  }
  const std::size_t upper = values.size() / 2;
  const std::size_t lower = (values.size() - 1) / 2;
  if (below > lower || upper >= below + inside) return {};
  return middle_of(std::span(scratch).first(inside), below, values.size());
}

constexpr std::size_t worth_a_window = 500;  // shorter ones are sorted as fast

}  // namespace

double median_magnitude(std::span<const double> values, Values& scratch) {
  GYROCAL_ASSERT(!values.empty());
  scratch.resize(values.size());
  if (values.size() >= worth_a_window) {
    const auto median = median_within(likely_window(values), values, scratch);
    if (median) return *median;
  }
  std::transform(values.begin(), values.end(), scratch.begin(),
                 [](double value) { return std::abs(value); });
  return middle_of(scratch, 0, scratch.size());
}

}  // namespace gyrocal
