#pragma once

#include <cstdint>

#include "compensation/discrepancy/dwell_data.h"

namespace gyrocal {

/// Robust centre and the two half widths of one dwell [deg/s]: medians and quantiles, which
/// glitches do not move.
struct DwellShape {
  double median = 0, below = 0, above = 0, sd = 0;
};

/// @param lsb_dps  width of a code, over which its counts are spread evenly; 0: continuous.
[[nodiscard]] DwellShape dwell_shape(const DwellData& dwell, double lsb_dps);

/// White noise per sample from neighbours' differences [deg/s]: blind to what moves slowly.
/// Rounding is taken off. 0 where there are fewer than 16 neighbours.
[[nodiscard]] double white_sd_dps(const DwellData& dwell, double lsb_dps);

[[nodiscard]] std::int64_t code_of(double y_dps, double lsb_dps);

}  // namespace gyrocal
