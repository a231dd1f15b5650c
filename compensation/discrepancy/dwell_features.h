#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gyrocal {

/// Numbers that sum a dwell up, chosen before any effect is known.
/// Source: discrepancy_methods.md section 3.
struct DwellFeatures {
  static constexpr std::size_t bands = 10;
  std::array<double, bands + 1> spectrum{};  ///< ln power in bands, ln(peak/median)
  std::array<double, 5> distribution{};      ///< ln sd, skew, excess kurtosis, tails, empty codes
  std::array<double, 2> link{};              ///< lost frames, longest run; variance-stabilised
  double sd_dps = 0;
  double lost_share = 0;
};

/// @param y_dps  samples that arrived, n >= 32.  @param seq  their numbers, ascending from 0.
/// @param lsb_dps  size of a count; 0 if the values are continuous.
[[nodiscard]] DwellFeatures dwell_features(std::span<const double> y_dps,
                                           std::span<const std::int64_t> seq, double lsb_dps);

}  // namespace gyrocal
