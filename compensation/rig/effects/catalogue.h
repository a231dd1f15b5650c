#pragma once

#include <span>
#include <string_view>

#include "compensation/rig/effects/effect.h"

namespace gyrocal::rig {

/// Every effect of DESIGN section 10, in its order.
[[nodiscard]] std::span<const Effect> catalogue();
/// nullptr if there is none of that name.
[[nodiscard]] const Effect* find_effect(std::string_view name);
/// nullptr if the effect has no such law.
[[nodiscard]] const Law* find_law(const Effect& effect, std::string_view name);

// One file an effect:
Effect temperature_rate();
Effect thermal_lag();
Effect thermal_hysteresis();
Effect self_heating();
Effect aging_drift();
Effect bias_jump();
Effect mode_crossing();
Effect condensation_step();
Effect stress_relaxation();
Effect g_sensitivity();
Effect board_sensor_offset();
Effect compressor_vibration();
Effect mains_hum();
Effect random_telegraph_noise();
Effect bias_instability();
Effect rate_random_walk();
Effect noise_temperature_dependence();
Effect missing_codes();
Effect saturation();
Effect outlier_glitches();
Effect stuck_samples();
Effect dropped_samples();

}  // namespace gyrocal::rig
