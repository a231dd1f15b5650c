#include "daemon/campaign/campaign.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/daemon/campaign/plans.h"

namespace gyrocal::campaign {
namespace {

const Plan plan = three_points();

template <class A>
int count(const Step& step) {
  int n = 0;
  for (const auto& action : step.actions) n += std::holds_alternative<A>(action) ? 1 : 0;
  return n;
}

Event any_event(std::mt19937& random) {
  const std::vector<Event> all = {
      Ready{{}},     NothingLeft{}, AtSetpoint{},       Settled{},        Unsettled{"no"},
      DwellDone{},   DwellShort{},  DwellDisturbed{""}, DeviceAway{""},   DeviceBack{},
      Restored{},    NotRestored{}, Analysed{},         Fault{"too hot"}, PauseAsked{},
      ResumeAsked{}, SkipAsked{},   AbortAsked{}};
  return all[random() % all.size()];
}

}  // namespace

SCENARIO("an undisturbed campaign visits every setpoint once, in order, and comes home") {
  State state = Preflight{};
  std::vector<double> sent;
  int dwells = 0;
  const auto feed = [&](const Event& event) {
    const Step next = step(plan, state, event);
    for (const auto& action : next.actions) {
      if (const auto* ramp = std::get_if<RampTo>(&action)) sent.push_back(ramp->target.value);
      dwells += std::holds_alternative<StoreDwell>(action) ? 1 : 0;
    }
    state = next.next;
  };
  feed(Ready{{}});
  for (int i = 0; i < 3; ++i) {
    feed(AtSetpoint{});
    feed(Settled{});
    feed(DwellDone{});
  }
  CHECK(std::holds_alternative<Returning>(state));
  feed(Restored{});
  CHECK(std::holds_alternative<Analysing>(state));
  feed(Analysed{});
  CHECK(std::holds_alternative<Finished>(state));
  CHECK(sent == std::vector<double>{-10, 20, 50, 25});
  CHECK(dwells == 3);
}

SCENARIO("an opened door costs one dwell, not the campaign") {
  WHEN("the air leaves its band while point 1 is logged") {
    const Step next = step(plan, Logging{{1}}, DwellDisturbed{"door"});
    THEN("the dwell is kept as rejected and point 1 is approached again") {
      CHECK(std::get<Ramping>(next.next).visit == Visit{1, 2, 1});
      REQUIRE(next.actions.size() == 2);
      CHECK(std::get<RejectDwell>(next.actions[0]).reason == "door");
      CHECK(std::get<RampTo>(next.actions[1]).target == Celsius{20});
    }
  }
  WHEN("the third of three tries is disturbed too") {
    const Step next = step(plan, Logging{{1, 3, 2}}, DwellDisturbed{"door"});
    THEN("the setpoint is given up and the next one begins") {
      CHECK(std::get<Ramping>(next.next).visit == Visit{2});
      CHECK(count<RejectDwell>(next) == 1);
      CHECK(count<Say>(next) == 1);
    }
  }
}

SCENARIO("a board that lost frames repeats its dwell; the others keep theirs") {
  const Step next = step(plan, Logging{{1}}, DwellShort{"left: 90 of 3000 frames missing"});
  CHECK(count<StoreDwell>(next) == 1);
  CHECK(std::get<Ramping>(next.next).visit == Visit{1, 2, 1});
}

SCENARIO("a device that goes away is waited for at the same setpoint") {
  const Step away = step(plan, Logging{{1}}, DeviceAway{"the chamber does not answer"});
  REQUIRE(std::holds_alternative<Holding>(away.next));
  CHECK(count<RejectDwell>(away) == 1);
  const Step back = step(plan, away.next, DeviceBack{});
  CHECK(std::get<Ramping>(back.next).visit == Visit{1, 2, 0});
}

SCENARIO("an operator pauses, resumes, skips and aborts") {
  const Step paused = step(plan, Logging{{1}}, PauseAsked{});
  CHECK(std::holds_alternative<Paused>(paused.next));
  CHECK(count<RejectDwell>(paused) == 1);
  CHECK(std::get<Ramping>(step(plan, paused.next, ResumeAsked{}).next).visit == Visit{1, 2, 0});
  CHECK(std::get<Ramping>(step(plan, Soaking{{1}}, SkipAsked{}).next).visit == Visit{2});
  CHECK(std::holds_alternative<Returning>(step(plan, Soaking{{2}}, SkipAsked{}).next));

  const Step aborted = step(plan, Soaking{{1}}, AbortAsked{});
  CHECK(std::get<RampTo>(aborted.actions.at(0)).target == plan.safe);
  CHECK(std::holds_alternative<Aborted>(step(plan, aborted.next, Restored{}).next));
}

SCENARIO("what is not awaited changes nothing") {
  CHECK(std::holds_alternative<Ramping>(step(plan, Ramping{{1}}, Settled{}).next));
  CHECK(step(plan, Ramping{{1}}, Settled{}).actions.empty());
  CHECK(std::holds_alternative<Soaking>(step(plan, Soaking{{1}}, ResumeAsked{}).next));
  CHECK(std::holds_alternative<Finished>(step(plan, Finished{}, AbortAsked{}).next));
}

TEST_CASE("a fault in any state but an ending makes the chamber safe", "[campaign]") {
  const std::vector<State> running = {Preflight{},  Ramping{{1}},   Soaking{{1}},
                                      Logging{{1}}, Paused{{1}},    Holding{{1}, "board"},
                                      Returning{},  Returning{true}};
  for (const State& state : running) {
    INFO(name(state));
    const Step next = step(plan, state, Fault{"over temperature"});
    CHECK(std::get<Safe>(next.next).why == "over temperature");
    CHECK(count<MakeSafe>(next) == 1);
  }
}

TEST_CASE("somebody else's hand on the panel means hands off", "[campaign]") {
  const Step next = step(plan, Soaking{{1}}, Fault{"the setpoint is not ours", true});
  CHECK(std::holds_alternative<Safe>(next.next));
  CHECK(count<MakeSafe>(next) == 0);
  CHECK(count<HoldRamp>(next) == 1);
}

TEST_CASE("once safe, always safe", "[campaign][property]") {
  const auto seed = GENERATE(range(0u, 300u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  State state = Safe{"over temperature"};
  for (int i = 0; i < 50; ++i) {
    const Step next = step(plan, state, any_event(random));
    CHECK(next.actions.empty());
    state = next.next;
  }
  CHECK(std::holds_alternative<Safe>(state));
}

TEST_CASE("whatever happens, the chamber is only sent where the plan says",
          "[campaign][property]") {
  const auto seed = GENERATE(range(0u, 300u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  State state = Preflight{};
  std::size_t furthest = 0;
  for (int i = 0; i < 200; ++i) {
    const Step next = step(plan, state, any_event(random));
    for (const auto& action : next.actions) {
      if (const auto* ramp = std::get_if<RampTo>(&action)) {
        CHECK(commandable(plan.allowed, ramp->target).has_value());
      }
    }
    if (const Visit* visit = visit_of(next.next)) {
      CHECK(visit->point >= furthest);  // never back to a setpoint that was left
      CHECK(visit->disturbed < plan.limits.dwell_attempts_max);
      furthest = visit->point;
    }
    state = next.next;
  }
}

TEST_CASE("no setpoint outside the limits, and no NaN, passes", "[campaign]") {
  CHECK(commandable(plan.allowed, Celsius{70}).has_value());
  CHECK(commandable(plan.allowed, Celsius{70.001}).error().code == Errc::out_of_range);
  CHECK(commandable(plan.allowed, Celsius{-60}).error().code == Errc::out_of_range);
  CHECK(commandable(plan.allowed, Celsius{std::nan("")}).error().code == Errc::not_finite);
  CHECK(commandable(plan.allowed, Celsius{-INFINITY}).error().code == Errc::not_finite);
}

TEST_CASE("a plan is costed before it runs", "[campaign]") {
  const Estimate cost = estimate(plan, Celsius{20});
  // 30 + 30 + 30 + 25 K at 1 K/min, three soaks of 30 min, three dwells of 60 s.
  CHECK(to_seconds(cost.duration) == Approx(115 * 60 + 3 * 1800 + 3 * 60));
  CHECK(to_seconds(cost.duration_max - cost.duration) == Approx(3 * 600));
  CHECK(cost.samples == 18000);
  CHECK(cost.monitor_rows == 2 * 2496);

  Plan slow = plan;
  slow.cooling_per_minute = Kelvin{0.5};  // 30 and 25 K of the way are downhill
  slow.heating_per_minute = Kelvin{3};    // faster than asked: no matter
  CHECK(to_seconds(estimate(slow, Celsius{20}).duration - cost.duration) == Approx(55 * 60));
}

}  // namespace gyrocal::campaign
