#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

bool found_with(const rig::EffectUse& use, std::uint64_t seed) {
  rig::RigModel model = quiet_rig();
  model.effects.push_back(use);
  const auto found = diagnose(rig::simulate_session(model, short_up_down(), seed), {}, {});
  REQUIRE(found.has_value());
  return std::any_of(found->findings.begin(), found->findings.end(), [&](const Finding& finding) {
    return finding.effect == use.effect ||
           std::count(finding.confounded_with.begin(), finding.confounded_with.end(), use.effect) >
               0;
  });
}

}  // namespace

TEST_CASE("an effect of twice its detection limit is found, one of a third is not") {
  const auto quiet = diagnose(rig::simulate_session(quiet_rig(), short_up_down(), 20), {}, {});
  REQUIRE(quiet.has_value());
  const auto& limits = quiet->detection_limits;
  struct Case {
    const char *effect, *law, *amplitude;
    std::vector<std::pair<std::string, double>> shape;
  };
  // Shapes near those the limits are told for.
  const std::vector<Case> cases{{"temperature_rate", "proportional", "k_r", {}},
                                {"thermal_hysteresis", "play", "h", {{"w", 2.5}}},
                                {"stress_relaxation", "one_time", "c", {{"tau", 4800}}}};
  for (const Case& one : cases) {
    CAPTURE(one.effect);
    const auto use = [&](double factor) {
      rig::EffectUse made{one.effect, one.law, one.shape};
      made.parameters.insert(made.parameters.begin(),
                             {one.amplitude, factor * limits.at(one.effect)});
      return made;
    };
    int seen_double = 0, seen_third = 0;
    for (const std::uint64_t seed : {21u, 22u}) {
      seen_double += found_with(use(2.0), seed);
      seen_third += found_with(use(0.33), seed);
    }
    CHECK(seen_double == 2);
    CHECK(seen_third == 0);
  }
}
