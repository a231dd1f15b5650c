#include "daemon/campaign/conditions.h"

#include <catch2/catch.hpp>

#include "tests/daemon/campaign/plans.h"

namespace gyrocal::campaign {
namespace {

/// Both boards read, and the air, every 5 s from `from_s` to `to_s`.
void feed(Conditions& conditions, double from_s, double to_s, Celsius air, Celsius board) {
  for (double t = from_s; t <= to_s; t += 5) {
    conditions.air(seconds(t), air);
    for (std::size_t i = 0; i < 2; ++i) conditions.board_temperature(i, seconds(t), board);
  }
}

Conditions at_twenty(const Plan& plan) {
  Conditions conditions(plan, seconds(15));
  conditions.air(seconds(0), Celsius{25});
  conditions.entered(Ramping{{1}}, seconds(0));
  return conditions;
}

template <class E>
bool is(const std::optional<Event>& event) {
  return event && std::holds_alternative<E>(*event);
}

}  // namespace

SCENARIO("a ramp has arrived when the air is in the band") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  CHECK_FALSE(conditions.due(Ramping{{1}}, seconds(5)));
  conditions.air(seconds(300), Celsius{20.2});
  CHECK(is<AtSetpoint>(conditions.due(Ramping{{1}}, seconds(300))));
}

SCENARIO("a ramp that never arrives is a fault, after twice its time and the extra") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);  // 5 K at 1 K/min: 300 s * 2 + 1800 s
  CHECK_FALSE(conditions.due(Ramping{{1}}, seconds(2400)));
  CHECK(is<Fault>(conditions.due(Ramping{{1}}, seconds(2401))));
}

SCENARIO("a soak ends when air and boards are stable and the shortest soak is over") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  conditions.entered(Soaking{{1}}, seconds(300));
  feed(conditions, 300, 2095, Celsius{20.1}, Celsius{20.5});
  CHECK_FALSE(conditions.due(Soaking{{1}}, seconds(2095)));
  feed(conditions, 2100, 2100, Celsius{20.1}, Celsius{20.5});
  CHECK(is<Settled>(conditions.due(Soaking{{1}}, seconds(2100))));
  CHECK_FALSE(conditions.soak(0).timed);
  CHECK(to_seconds(conditions.soak(0).in_band) == 1800);
}

SCENARIO("a board that drifts holds the soak, and the longest soak bounds it") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  conditions.entered(Soaking{{1}}, seconds(300));
  for (double t = 300; t <= 7505; t += 5) {
    feed(conditions, t, t, Celsius{20.0}, Celsius{15 + 3 * t / 3600});
    const auto due = conditions.due(Soaking{{1}}, seconds(t));
    if (t <= 7500) {
      REQUIRE_FALSE(due);
    } else {
      CHECK(is<Unsettled>(due));
    }
  }
}

SCENARIO("a frozen board sensor makes its soak a timed one") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  conditions.entered(Soaking{{1}}, seconds(300));
  conditions.sensor_frozen(1, true);
  for (double t = 300; t <= 2100; t += 5) {
    conditions.air(seconds(t), Celsius{20});
    conditions.board_temperature(0, seconds(t), Celsius{20});
  }
  CHECK(is<Settled>(conditions.due(Soaking{{1}}, seconds(2100))));
  CHECK(conditions.soak(1).timed);
  CHECK_FALSE(conditions.soak(0).timed);
}

SCENARIO("a board that is away is waited for; one given up is not") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  conditions.entered(Soaking{{1}}, seconds(300));
  conditions.presence(1, Presence::away);
  feed(conditions, 300, 2100, Celsius{20}, Celsius{20});
  const auto due = conditions.due(Soaking{{1}}, seconds(2100));
  REQUIRE(is<DeviceAway>(due));
  CHECK(std::get<DeviceAway>(*due).why == "board right is away");
  conditions.presence(1, Presence::given_up);
  CHECK(is<Settled>(conditions.due(Soaking{{1}}, seconds(2100))));
}

SCENARIO("air leaving the dwell's band disturbs it; samples that do not come end it") {
  const Plan plan = three_points();
  Conditions conditions = at_twenty(plan);
  conditions.air(seconds(100), Celsius{20});
  conditions.entered(Logging{{1}}, seconds(100));
  CHECK_FALSE(conditions.due(Logging{{1}}, seconds(160)));
  CHECK(is<DwellDisturbed>(conditions.due(Logging{{1}}, seconds(231))));  // 2 * 60 s + 10 s
  conditions.air(seconds(110), Celsius{20.51});
  CHECK(is<DwellDisturbed>(conditions.due(Logging{{1}}, seconds(110))));
}

SCENARIO("the way home ends near the safe temperature, or is given up with a warning") {
  const Plan plan = three_points();
  Conditions conditions(plan, seconds(15));
  conditions.air(seconds(0), Celsius{50});
  conditions.entered(Returning{}, seconds(0));
  conditions.commanded(plan.safe);
  CHECK_FALSE(conditions.due(Returning{}, seconds(4800)));  // 25 min * 2 + 30 min
  CHECK(is<NotRestored>(conditions.due(Returning{}, seconds(4801))));
  conditions.air(seconds(1500), Celsius{26.9});
  CHECK(is<Restored>(conditions.due(Returning{}, seconds(1500))));
  conditions.commanded(Celsius{26});  // the last step of the ramp has not been written
  CHECK_FALSE(conditions.due(Returning{}, seconds(1500)));
}

SCENARIO("a chamber that is slow, but on its way, is waited for; one that stands still is not") {
  const Plan plan = three_points();
  Conditions conditions(plan, seconds(15));
  conditions.air(seconds(0), Celsius{20});
  conditions.entered(Ramping{{2}}, seconds(0));  // 30 K at 1 K/min: 30 min * 2 + 30 min
  for (double t = 0; t <= 8400; t += 5) conditions.air(seconds(t), Celsius{20 + 0.2 * t / 60});
  CHECK_FALSE(conditions.due(Ramping{{2}}, seconds(8400)));
  conditions.air(seconds(10200), Celsius{48});
  CHECK(is<Fault>(conditions.due(Ramping{{2}}, seconds(10200))));
}

}  // namespace gyrocal::campaign
