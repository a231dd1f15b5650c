#pragma once

#include <cmath>
#include <optional>

#include "compensation/rig/chamber_air.h"
#include "daemon/campaign/conditions.h"
#include "daemon/campaign/ramp.h"
#include "daemon/campaign/supervisor.h"

namespace gyrocal::campaign {

/// The paper's 25 setpoints with two boards.
inline Plan paper_plan() {
  Plan plan;
  for (const double c : {-10, -7, -5, -2, 0,  3,  5,  8,  10, 13, 15, 18, 20,
                         23,  25, 28, 30, 33, 35, 38, 40, 43, 45, 48, 50}) {
    plan.setpoints.push_back(Celsius{c});
  }
  plan.allowed = {Celsius{-20}, Celsius{70}};
  plan.poll_interval = std::chrono::seconds{5};
  plan.boards = {"left", "right"};
  plan.stability.air_peak_to_peak = Kelvin{0.4};
  return plan;
}

/// One campaign, decisions alone: state machine, waits and supervisor against the rig's air, no
/// board bytes. Its events are those of a world in which nothing goes wrong.
class CleanCampaign {
 public:
  CleanCampaign(const Plan& plan, const rig::ChamberPhysics& physics)
      : plan_(plan),
        air_(physics),
        conditions_(plan, 3 * plan.poll_interval),
        supervisor_(plan.allowed) {}

  State run() {
    feed(Ready{});
    for (; !ended(state_) && !std::holds_alternative<Analysing>(state_); t_ += plan_.poll_interval)
      turn();
    return state_;
  }
  [[nodiscard]] Duration length() const { return t_; }
  [[nodiscard]] int dwells() const { return dwells_; }

 private:
  void turn() {
    const Celsius air = air_.at(to_seconds(t_));
    board_c_ += (air.value - board_c_) * to_seconds(plan_.poll_interval) / 240;
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
    if (std::holds_alternative<Logging>(state_) && t_ - dwell_began_ >= std::chrono::seconds{60}) {
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

}  // namespace gyrocal::campaign
