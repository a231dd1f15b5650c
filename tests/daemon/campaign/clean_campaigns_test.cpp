// Decisions alone, over chambers that are well: state machine, waits and supervisor against the
// rig's air, 25 setpoints each, no board bytes. No chamber of 0.5 to 3 times the usual speed may
// raise an alarm.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <random>

#include "tests/daemon/campaign/clean_campaign.h"

namespace gyrocal::campaign {
namespace {

constexpr int seeds = 1000;

rig::ChamberPhysics any_chamber(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double speed = 0.5 * std::pow(6.0, unit(random));
  rig::ChamberPhysics physics;
  physics.heating_c_per_min *= speed;
  physics.cooling_c_per_min *= speed;
  physics.approach_tau_s /= speed;
  physics.cycling_c = 0.18 * unit(random);
  physics.cycling_period_s = 200 + 600 * unit(random);
  return physics;
}

}  // namespace

TEST_CASE("a thousand clean campaigns raise no alarm and log every setpoint", "[supervisor]") {
  const Plan plan = paper_plan();
  const auto began = std::chrono::steady_clock::now();
  Duration campaign_time{};
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    CleanCampaign campaign(plan, any_chamber(random));
    const State state = campaign.run();
    INFO(describe(plan, state));
    REQUIRE(std::holds_alternative<Analysing>(state));
    REQUIRE(campaign.dwells() == 25);
    campaign_time += campaign.length();
  }
  const double wall_s = to_seconds(std::chrono::steady_clock::now() - began);
  std::cout << seeds << " campaigns of 25 setpoints, " << to_seconds(campaign_time) / seeds / 3600
            << " h each: decisions at " << to_seconds(campaign_time) / wall_s
            << " x real time\n";  // told, not judged
}

}  // namespace gyrocal::campaign
