#include <catch2/catch.hpp>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

using Names = std::vector<std::string>;
constexpr rig::CubicBias straight{{3.2, 0.6, 0, 0}};
constexpr rig::CubicBias bent{{3.2, 0.1, 0.8, -0.3}};

/// The one finding in a session there and back of a board with this bias.
Finding found_in(const rig::CubicBias& bias, const rig::EffectUse& hidden) {
  rig::RigModel model = quiet_rig();
  model.baseline.bias[2] = bias;
  model.effects.push_back(hidden);
  const auto diagnosis = diagnose(rig::simulate_session(model, short_up_down(), 31), {}, {});
  REQUIRE(diagnosis.has_value());
  REQUIRE(diagnosis->findings.size() == 1);
  return diagnosis->findings[0];
}

}  // namespace

TEST_CASE("the tail of a relaxation could be a part of a straight bias that trails") {
  const rig::EffectUse weaker{"stress_relaxation", "one_time", {{"c", -3}, {"tau", 800}}};
  const Finding doubted = found_in(straight, weaker);
  CHECK(doubted.effect == "stress_relaxation");
  CHECK(doubted.confounded_with == Names{"thermal_lag"});
  CHECK_FALSE(doubted.tell_apart.empty());
  CHECK(found_in(bent, weaker).confounded_with.empty());
}

TEST_CASE("a part of the bias trails, it neither leads nor doubles") {
  for (const double c : {3.0, -40.0}) {
    const Finding sure =
        found_in(straight, {"stress_relaxation", "one_time", {{"c", c}, {"tau", 800}}});
    CHECK(sure.effect == "stress_relaxation");
    CHECK(sure.confounded_with.empty());
  }
}

TEST_CASE("rate and lag are one effect over a straight bias, two over a bent one") {
  const rig::EffectUse rate{"temperature_rate", "proportional", {{"k_r", -0.02}}};
  const rig::EffectUse lag{"thermal_lag", "pole", {{"tau", 60}}};
  CHECK(found_in(straight, rate).confounded_with == Names{"thermal_lag"});
  CHECK(found_in(straight, lag).confounded_with == Names{"temperature_rate"});
  CHECK(found_in(bent, rate).confounded_with.empty());
  CHECK(found_in(bent, lag).confounded_with.empty());
}
