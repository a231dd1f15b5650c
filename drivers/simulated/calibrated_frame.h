#pragma once

#include <cstdint>

#include "drivers/board/frame.h"
#include "drivers/simulated/sensor_parameters.h"

namespace gyrocal {

/// What firmware 2.2 makes of a raw frame in calibrated mode, faults included: acceleration [mg],
/// whole deg/s cut toward zero, field [mG], pressure [0.1 mbar], temperature [0.1 degC] with its
/// sign gone wrong. The counter stays. Source: fact sheet section 1 and 2.
[[nodiscard]] inemo::DataFrame calibrated(const inemo::DataFrame& raw,
                                          const SensorParameters& parameters);

/// The calibrated temperature word: half degrees cut to 8 bits, times 5, sign in bit 15. Right
/// above 0 degC; -10 degC arrives as 0x849C.
[[nodiscard]] std::int16_t calibrated_temperature(std::int16_t raw);

}  // namespace gyrocal
