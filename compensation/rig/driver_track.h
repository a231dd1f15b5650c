#pragma once

#include <span>
#include <vector>

#include "compensation/rig/effects/effect.h"
#include "compensation/values/records.h"

namespace gyrocal::rig {

/// The drivers at each monitor row: board and die from the chamber's record through the two lags,
/// started in equilibrium with the first air temperature. A coarse board sensor is never
/// differenced. Where a row has no chamber temperature the last one holds; where no row has one,
/// the board's column stands for the board and only the die's lag is applied (then chamber = board,
/// and what the chamber would have told, compressor and condensation, is not there).
/// The chamber's rate is the straight line through the rows within +-smoothing_s.
/// @return one per row; empty if neither chamber nor board was recorded. O(n).
[[nodiscard]] std::vector<Drivers> track_drivers(std::span<const MonitorRow> monitor,
                                                 double board_tau_s, double die_tau_s,
                                                 double smoothing_s = 20.0);

}  // namespace gyrocal::rig
