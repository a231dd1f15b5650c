#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// The four filters of an orthogonal wavelet, all of the same even length. With f = rec_lo of
/// length F: dec_lo(k) = f(F-1-k), rec_hi(k) = (-1)^k f(F-1-k), dec_hi(k) = rec_hi(F-1-k).
/// Source: Mallat, A Wavelet Tour of Signal Processing, section 7.3; signs as PyWavelets has them.
/// Held to tests/golden/filter_banks.json.
struct FilterBank {
  std::string_view name;
  std::vector<double> dec_lo;
  std::vector<double> dec_hi;
  std::vector<double> rec_lo;
  std::vector<double> rec_hi;
  [[nodiscard]] std::size_t taps() const { return rec_lo.size(); }
};

/// haar, db2..db10, sym2..sym8, coif1..coif5, in this order. Lives as long as the program.
[[nodiscard]] const std::vector<FilterBank>& filter_banks();

/// @param name  as in filter_banks(), or "db1" for haar.
/// @return the bank (lives as long as the program); unknown_name with the list of known names.
[[nodiscard]] Result<const FilterBank*> find_filter_bank(std::string_view name);

}  // namespace gyrocal
