#pragma once

#include <cstdint>
#include <vector>

#include "compensation/values/units.h"
#include "config/campaign.h"

namespace gyrocal {

/// The paper's 25 setpoints, -10 to 50 degC (its Table 1).
[[nodiscard]] std::vector<Celsius> paper_setpoints();

/// The setpoints in the order they are visited. `shuffled` depends on the seed alone, on every
/// machine: Fisher-Yates over SplitMix64, since std::shuffle is free to differ between libraries.
[[nodiscard]] std::vector<Celsius> in_visiting_order(std::vector<Celsius> listed, Sweep sweep,
                                                     std::uint64_t seed);

}  // namespace gyrocal
