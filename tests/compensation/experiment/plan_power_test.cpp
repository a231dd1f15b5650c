#include "compensation/experiment/plan_power.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "compensation/experiment/plan_additions.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

rig::SessionPlan one_way() {
  rig::SessionPlan plan;
  plan.setpoints_c = {-10, -3, 4, 11, 18, 25, 32, 39, 46};
  return plan;
}

const PlanPair& pair_of(const PlanPower& power, const std::string& a, const std::string& b) {
  const auto found = std::find_if(power.pairs.begin(), power.pairs.end(), [&](const PlanPair& p) {
    return (p.effect == a && p.rival == b) || (p.effect == b && p.rival == a);
  });
  REQUIRE(found != power.pairs.end());
  return *found;
}

}  // namespace

TEST_CASE("one way up, hysteresis is the rate of temperature in disguise", "[experiment]") {
  const PlanPower up = plan_power(one_way(), quiet_rig(), Axis::z).value();
  CHECK(up.dwells == 9);
  rig::SessionPlan both_ways = one_way();
  both_ways.sweep = rig::Sweep::up_down;
  const PlanPower up_down = plan_power(both_ways, quiet_rig(), Axis::z).value();
  CHECK(up_down.dwells == 17);
  CHECK(up_down.duration_h > 1.7 * up.duration_h);

  const PlanPair& before = pair_of(up, "aging_drift", "thermal_hysteresis");
  const PlanPair& after = pair_of(up_down, "aging_drift", "thermal_hysteresis");
  CHECK(before.share_left < after.share_left);
  CHECK(is_told_apart(after));
}

TEST_CASE("shares lie between 0 and 1, the most alike first, and louder noise asks for more",
          "[experiment]") {
  const PlanPower soft = plan_power(one_way(), quiet_rig(), Axis::z).value();
  CHECK(soft.limits.size() + soft.not_observable.size() == 22);
  double before = 0;
  for (const PlanPair& pair : soft.pairs) {
    CHECK(pair.share_left >= before);
    CHECK(pair.share_left <= 1);
    CHECK(pair.apart_from > 0);
    before = pair.share_left;
  }
  rig::RigModel loud = quiet_rig();
  loud.baseline.noise_dps = 1;
  const PlanPower noisy = plan_power(one_way(), loud, Axis::z).value();
  const PlanPair& quiet_pair = pair_of(soft, "aging_drift", "bias_jump");
  const PlanPair& loud_pair = pair_of(noisy, "aging_drift", "bias_jump");
  CHECK(loud_pair.share_left == Approx(quiet_pair.share_left).margin(0.05));
  CHECK(loud_pair.apart_from > 5 * quiet_pair.apart_from);
}

TEST_CASE("additions are judged by what they separate for their hours", "[experiment]") {
  const PlanPower power = plan_power(one_way(), quiet_rig(), Axis::z).value();
  const auto additions = plan_additions(one_way(), quiet_rig(), Axis::z, power).value();
  REQUIRE(additions.size() == 4);
  CHECK_FALSE(additions.front().separated.empty());
  for (const PlanAddition& addition : additions) {
    CHECK(addition.extra_h >= 0);
    for (const PlanPair& pair : addition.separated) {
      CHECK(is_told_apart(pair));
      CHECK_FALSE(is_told_apart(pair_of(power, pair.effect, pair.rival)));
    }
  }
}

TEST_CASE("a plan that cannot be judged is refused", "[experiment][bad input]") {
  rig::SessionPlan none = one_way();
  none.setpoints_c.clear();
  CHECK(plan_power(none, quiet_rig(), Axis::z).error().code == Errc::too_few_points);
  rig::RigModel unknown = quiet_rig();
  unknown.effects.push_back({.effect = "gremlins"});
  CHECK(plan_power(one_way(), unknown, Axis::z).error().code == Errc::unknown_name);
}
