// Decisions alone, over chambers that are well: state machine, waits and supervisor against the
// rig's air, 25 setpoints each, no board bytes. No chamber of 0.5 to 3 times the usual speed may
// raise an alarm.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <random>

#include "compensation/rig/chamber_air.h"
#include "daemon/campaign/conditions.h"
#include "daemon/campaign/ramp.h"
#include "daemon/campaign/supervisor.h"

namespace gyrocal::campaign {
namespace {

constexpr int seeds = 1000;
constexpr Duration poll = std::chrono::seconds{5};
constexpr double sixty_s = 60;

Plan paper_plan() {
  Plan plan;
  for (const double c : {-10, -7, -5, -2, 0,  3,  5,  8,  10, 13, 15, 18, 20,
                         23,  25, 28, 30, 33, 35, 38, 40, 43, 45, 48, 50}) {
    plan.setpoints.push_back(Celsius{c});
  }
  plan.allowed = {Celsius{-20}, Celsius{70}};
  plan.poll_interval = poll;
  plan.boards = {"left", "right"};
  plan.stability.air_peak_to_peak = Kelvin{0.4};
  return plan;
}

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

/// One campaign; its events are those of a world in which nothing goes wrong.
class CleanCampaign {
 public:
  CleanCampaign(const Plan& plan, const rig::ChamberPhysics& physics)
      : plan_(plan), air_(physics), conditions_(plan, 3 * poll), supervisor_(plan.allowed) {}

  State run() {
    feed(Ready{});
    for (; !ended(state_) && !std::holds_alternative<Analysing>(state_); t_ += poll) turn();
    return state_;
  }
  [[nodiscard]] Duration length() const { return t_; }
  [[nodiscard]] int dwells() const { return dwells_; }

 private:
  void turn() {
    const Celsius air = air_.at(to_seconds(t_));
    board_c_ += (air.value - board_c_) * to_seconds(poll) / 240;
    conditions_.air(t_, air);
    for (std::size_t i = 0; i < plan_.boards.size(); ++i) {
      conditions_.board_temperature(i, t_, Celsius{std::round(2 * board_c_) / 2});
    }
    const ChamberReading reading{air, commanded_.value_or(air), ChamberRun::running, true};
    if (const auto trip = supervisor_.look(t_, reading, commanded_)) {
      return feed(Fault{trip->why, trip->hands_off});
    }
    if (const auto setpoint = ramp_ ? ramp_->due(t_) : std::nullopt) {
      air_.run(to_seconds(t_), *setpoint);
      ramp_->written(t_, *setpoint);
      commanded_ = setpoint;
    }
    if (std::holds_alternative<Logging>(state_) && t_ - dwell_began_ >= seconds(sixty_s)) {
      return feed(DwellDone{});
    }
    conditions_.commanded(commanded_);
    if (const auto event = conditions_.due(state_, t_)) feed(*event);
  }

  void feed(const Event& event) {
    Step next = step(plan_, state_, event);
    state_ = std::move(next.next);
    conditions_.entered(state_, t_);
    for (const auto& action : next.actions) {
      if (const auto* ramp = std::get_if<RampTo>(&action)) {
        ramp_.emplace(t_, air_.at(to_seconds(t_)), ramp->target, plan_.ramp_per_minute);
        supervisor_.sent_to(ramp->target);
      }
      if (std::holds_alternative<BeginDwell>(action)) dwell_began_ = t_;
      if (std::holds_alternative<StoreDwell>(action)) ++dwells_;
    }
  }

  const Plan& plan_;
  rig::ChamberAir air_;
  Conditions conditions_;
  Supervisor supervisor_;
  State state_ = Preflight{};
  Duration t_{};
  Duration dwell_began_{};
  std::optional<SetpointRamp> ramp_;
  std::optional<Celsius> commanded_;
  double board_c_ = 23;
  int dwells_ = 0;
};

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
