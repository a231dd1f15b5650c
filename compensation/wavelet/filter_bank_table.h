#pragma once

#include <span>
#include <string_view>

namespace gyrocal {

/// A wavelet's reconstruction low-pass filter; the other three filters follow from it.
struct NamedFilter {
  std::string_view name;
  std::span<const double> rec_lo;
};

[[nodiscard]] std::span<const NamedFilter> low_pass_filters();

}  // namespace gyrocal
