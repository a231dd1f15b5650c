#include "compensation/rig/effects/catalogue.h"

namespace gyrocal::rig {
namespace {

std::vector<Effect> all_effects() {
  constexpr Effect (*makers[])() = {
      temperature_rate,
      thermal_lag,
      thermal_hysteresis,
      self_heating,
      aging_drift,
      bias_jump,
      mode_crossing,
      condensation_step,
      stress_relaxation,
      g_sensitivity,
      board_sensor_offset,
      compressor_vibration,
      mains_hum,
      random_telegraph_noise,
      bias_instability,
      rate_random_walk,
      noise_temperature_dependence,
      missing_codes,
      saturation,
      outlier_glitches,
      stuck_samples,
      dropped_samples,
  };
  std::vector<Effect> effects;
  for (const auto make : makers) effects.push_back(make());
  return effects;
}

}  // namespace

std::span<const Effect> catalogue() {
  static const std::vector<Effect> effects = all_effects();
  return effects;
}

const Effect* find_effect(std::string_view name) {
  for (const Effect& effect : catalogue()) {
    if (effect.name == name) return &effect;
  }
  return nullptr;
}

const Law* find_law(const Effect& effect, std::string_view name) {
  for (const auto& law : effect.laws) {
    if (law->info.name == name) return law.get();
  }
  return nullptr;
}

}  // namespace gyrocal::rig
