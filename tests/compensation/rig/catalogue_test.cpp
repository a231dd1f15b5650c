#include "compensation/rig/effects/catalogue.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

/// A made-up record with ramps both ways, so that every driver moves.
std::vector<Drivers> some_record() {
  std::vector<Drivers> record;
  for (int i = 0; i < 2000; ++i) {
    Drivers now;
    now.t_s = now.t_on_s = 20.0 * i;
    now.die_c = 20.0 + 30.0 * std::sin(i * 0.01);
    now.board_c = now.die_c - 1.0;
    now.chamber_c = now.die_c + 1.0;
    now.die_rate_c_per_min = 0.9 * std::cos(i * 0.01);
    now.chamber_rate_c_per_min = now.die_rate_c_per_min;
    now.acc_g = {0.1 * std::sin(i * 0.003), 0.0, 1.0};
    record.push_back(now);
  }
  return record;
}

}  // namespace

TEST_CASE("the catalogue holds the effects of the design in its order") {
  std::string names;
  for (const Effect& effect : catalogue()) names += std::string(effect.name) + " ";
  CHECK(names ==
        "temperature_rate thermal_lag thermal_hysteresis self_heating aging_drift bias_jump "
        "mode_crossing condensation_step stress_relaxation g_sensitivity board_sensor_offset "
        "compressor_vibration mains_hum random_telegraph_noise bias_instability rate_random_walk "
        "noise_temperature_dependence missing_codes saturation outlier_glitches stuck_samples "
        "dropped_samples ");
  CHECK(find_effect("moon_phase") == nullptr);
}

TEST_CASE("every law is documented and its default values are in range") {
  for (const Effect& effect : catalogue()) {
    CAPTURE(effect.name);
    CHECK(effect.physics.size() > 80);
    CHECK(effect.channels != 0);
    CHECK_FALSE(effect.laws.empty());
    CHECK_FALSE(effect.confused_with.empty());
    for (const Confusion& confusion : effect.confused_with) {
      CAPTURE(confusion.effect);
      CHECK(find_effect(confusion.effect) != nullptr);
    }
    for (const auto& law : effect.laws) {
      CAPTURE(law->info.name);
      CHECK_FALSE(law->info.parameters.empty());
      for (const Parameter& p : law->info.parameters) {
        CAPTURE(p.name);
        CHECK(p.low < p.high);
        CHECK(p.usual >= p.low);
        CHECK(p.usual <= p.high);
        CHECK_FALSE(p.meaning.empty());
      }
      CHECK(instantiate(EffectUse{std::string(effect.name), std::string(law->info.name), {}}));
    }
  }
}

TEST_CASE("a law that says it is linear is proportional to its first parameter") {
  const auto record = some_record();
  const CubicBias bias = Baseline{}.bias[2];
  for (const Effect& effect : catalogue()) {
    for (const auto& law : effect.laws) {
      if (!law->info.linear || (effect.channels & slow_drift) == 0) continue;
      CAPTURE(effect.name, law->info.name);
      auto values = usual_values(*law);
      const auto once = drift_over(*law, values, bias, record);
      values[0] *= -3.0;
      const auto thrice = drift_over(*law, values, bias, record);
      double size = 0.0;
      for (std::size_t i = 0; i < record.size(); ++i) {
        size += std::abs(once[i]);
        REQUIRE(thrice[i] == Approx(-3.0 * once[i]).epsilon(1e-12).margin(1e-15));
      }
      CHECK(size > 0.0);
    }
  }
}

TEST_CASE("an unknown effect, law or parameter is refused with the list of known ones") {
  auto refused = instantiate(EffectUse{"moon_phase", "", {}});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::unknown_name);
  CHECK(refused.error().advice.find("thermal_hysteresis") != std::string::npos);
  refused = instantiate(EffectUse{"thermal_hysteresis", "bouc_wen", {}});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().advice == "known: play, play_pair, relay, direction");
  refused = instantiate(EffectUse{"thermal_hysteresis", "play", {{"q", 1.0}}});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().advice == "known: h, w");
}

TEST_CASE("a parameter out of range or not a number is refused with the range") {
  auto refused = instantiate(EffectUse{"thermal_hysteresis", "play", {{"w", 400.0}}});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::out_of_range);
  CHECK(refused.error().what ==
        "effect thermal_hysteresis, law play, parameter w: 400 degC is out of range");
  CHECK(refused.error().advice == "allowed: 0.1..40 degC");
  refused = instantiate(EffectUse{"thermal_hysteresis", "play", {{"h", std::nan("")}}});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::not_finite);
}
