// What goes wrong on a weekend, in virtual time, against the simulated rig: one event an outage and
// one when it ends, no dwell lost, none twice, and the chamber never where it must not be.
#include <catch2/catch.hpp>

#include "tests/daemon/runner/virtual_bench.h"

namespace gyrocal::runner {
namespace {

using campaign::Finished;
using campaign::Safe;

bool finished(const Outcome& outcome) { return std::holds_alternative<Finished>(outcome.state); }

}  // namespace

SCENARIO("nothing goes wrong") {
  VirtualBench bench(short_campaign);
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.events.size() == 1);  // transitions
}

SCENARIO("a board unplugged in the middle of a dwell comes back a minute later") {
  VirtualBench bench(short_campaign);
  bench.when("logging", 1, [&](Duration t) {
    bench.rig.board(0).unplug(bench.clock.now());
    bench.at(to_seconds(t) + 60, [&] { bench.rig.board(0).plug_in(bench.clock.now()); });
  });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.events["board_lost"] == 1);
  CHECK(bench.events["board_back"] == 1);
}

SCENARIO("a board that stays away costs its own dwells, not the campaign") {
  VirtualBench bench(short_campaign);
  bench.when("soaking", 1, [&](Duration) { bench.rig.board(1).unplug(bench.clock.now()); });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 6);
  CHECK(bench.events["board_lost"] == 1);
  CHECK(bench.events["board_given_up"] == 1);
  CHECK(bench.events["board_back"] == 0);
}

SCENARIO("a brown-out in a dwell: it is kept, marked and repeated; the other board keeps its own") {
  VirtualBench bench(short_campaign);
  bench.when("logging", 2, [&](Duration t) {
    bench.at(to_seconds(t) + 10, [&] { bench.rig.board(0).brown_out(bench.clock.now()); });
  });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.said("ramping at 26.0 degC (point 3 of 5, attempt 2)"));
}

SCENARIO(
    "the chamber does not answer for twenty seconds: waited for, one event and one at its end") {
  VirtualBench bench(short_campaign);
  bench.when("soaking", 1, [&](Duration t) {
    bench.link.cut = true;
    bench.at(to_seconds(t) + 20, [&] { bench.link.cut = false; });
  });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.events["chamber_lost"] == 1);
  CHECK(bench.events["chamber_back"] == 1);
}

SCENARIO(
    "the chamber does not answer for an hour: safe state, and its safe setpoint when it returns") {
  VirtualBench bench(short_campaign);
  bench.when("logging", 1, [&](Duration t) {
    bench.link.cut = true;
    bench.at(to_seconds(t) + 3600, [&] { bench.link.cut = false; });
  });
  const Outcome outcome = bench.run();
  REQUIRE(std::holds_alternative<Safe>(outcome.state));
  CHECK(bench.chamber.read()->setpoint == Celsius{25});
  CHECK(bench.events["safe_setpoint"] == 1);
  CHECK(bench.link.requests < 5000);
  CHECK(bench.store.campaign(outcome.campaign)->state == "safe");
}

SCENARIO("the chamber never answers again: told, after half a day of trying with patience") {
  VirtualBench bench(short_campaign);
  bench.when("soaking", 1, [&](Duration) { bench.link.cut = true; });
  const Outcome outcome = bench.run();
  CHECK(std::holds_alternative<Safe>(outcome.state));
  CHECK(bench.events["not_safe"] == 1);
  CHECK(bench.events["chamber_lost"] == 1);
}

SCENARIO("lone zeros and jumps among the readings disturb nothing") {
  VirtualBench bench(short_campaign);
  int n = 0;
  bench.chamber.doctor = [&](ChamberReading& reading) {
    ++n;
    if (n > 5 && n % 50 == 0) reading.actual = Celsius{0.0};
    if (n > 5 && n % 77 == 0) reading.actual = Celsius{-200};
  };
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.events["doubtful_reading"] > 0);
  CHECK(bench.events["doubtful_reading"] < 40);
}

SCENARIO(
    "the process is stopped for over a minute in a dwell: what the air did then is not known") {
  VirtualBench bench(short_campaign);
  bench.when("logging", 1, [&](Duration t) {
    bench.at(to_seconds(t) + 5,
             [&] { bench.clock.sleep_until(bench.clock.now() + std::chrono::seconds{62}); });
  });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.said("ramping at 18.0 degC (point 2 of 5, attempt 2)"));
  const auto boards = *bench.store.boards(outcome.campaign);
  for (const auto& [id, board] : boards) {
    const auto dwells = *bench.store.accepted_dwells(outcome.campaign, id);
    for (const auto& dwell : dwells) CHECK(std::isfinite(dwell.chamber_mean_c));
  }
}

SCENARIO("a door opened during a dwell costs that dwell") {
  VirtualBench bench(short_campaign);
  bench.when("logging", 3, [&](Duration t) {
    bench.chamber.doctor = [](ChamberReading& reading) {
      reading.actual = reading.actual - Kelvin{3};
    };
    bench.at(to_seconds(t) + 120, [&] { bench.chamber.doctor = nullptr; });
  });
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.said("ramping at 34.0 degC (point 4 of 5, attempt 2)"));
}

SCENARIO("somebody sets another temperature at the panel: hands off") {
  VirtualBench bench(short_campaign);
  InProcessChamberLink panel(bench.rig.chamber(), bench.clock, seconds(1));
  ModbusChamber person(panel, bench.clock, bench.config.chamber.profile, 1);
  std::size_t writes_then = 0;
  bench.when("soaking", 2, [&](Duration) {
    REQUIRE(person.set_setpoint(Celsius{55}));
    writes_then = bench.chamber.written.size();
  });
  const Outcome outcome = bench.run();
  REQUIRE(std::holds_alternative<Safe>(outcome.state));
  CHECK(bench.chamber.written.size() == writes_then);
  CHECK(bench.chamber.read()->setpoint == Celsius{55});
  CHECK(bench.events["hands_off"] == 1);
}

SCENARIO("somebody stops the chamber at the panel: hands off") {
  VirtualBench bench(short_campaign);
  InProcessChamberLink panel(bench.rig.chamber(), bench.clock, seconds(1));
  ModbusChamber person(panel, bench.clock, bench.config.chamber.profile, 1);
  bench.when("logging", 0, [&](Duration) { REQUIRE(person.stop()); });
  const Outcome outcome = bench.run();
  REQUIRE(std::holds_alternative<Safe>(outcome.state));
  CHECK(bench.chamber.read()->run == ChamberRun::stopped);
}

SCENARIO("air that climbs past every limit: the safe setpoint is confirmed within ten seconds") {
  VirtualBench bench(short_campaign);
  double too_warm_k = 0;
  bench.when("soaking", 4, [&](Duration) {
    bench.chamber.doctor = [&](ChamberReading& reading) {
      reading.actual = reading.actual + Kelvin{too_warm_k += 2};
    };
  });
  bench.when("safe", 4, [&](Duration) { bench.chamber.doctor = nullptr; });
  const Outcome outcome = bench.run();
  REQUIRE(std::holds_alternative<Safe>(outcome.state));
  CHECK(std::get<Safe>(outcome.state).why.find("beyond what boards and chamber allow") !=
        std::string::npos);
  CHECK(bench.seen_s["safe_setpoint"] - bench.seen_s["trip"] <= 10);
  CHECK(bench.chamber.read()->setpoint == Celsius{25});
  CHECK(std::abs((bench.chamber.read()->actual - Celsius{25}).value) <= 2);
}

SCENARIO("a temperature register that stands still is noticed and read in breaks") {
  VirtualBench bench(short_campaign);
  bench.rig.board(1).set_temperature_trap(true);
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  CHECK(bench.events["sensor_frozen"] == 1);
  const auto boards = *bench.store.boards(outcome.campaign);
  const auto dwells = *bench.store.accepted_dwells(outcome.campaign, boards[1].first);
  CHECK(std::abs(dwells.back().board_mean_c - 42) < 1.5);
}

TEST_CASE("chambers half as fast and three times as fast raise no false alarm", "[supervisor]") {
  const auto seed = GENERATE(range(1u, 25u));
  const double speed = 0.5 * std::pow(6.0, (seed % 12) / 11.0);
  CAPTURE(seed, speed);
  rig::RigModel model;
  model.baseline.chamber.heating_c_per_min *= speed;
  model.baseline.chamber.cooling_c_per_min *= speed;
  model.baseline.chamber.approach_tau_s /= speed;
  VirtualBench bench(short_campaign, model, seed);
  const Outcome outcome = bench.run();
  CHECK(finished(outcome));
  CHECK(bench.accepted(outcome.campaign) == 10);
  for (const auto& text : bench.texts) {
    INFO(text);
    CHECK(text.starts_with("transition"));
  }
}

}  // namespace gyrocal::runner
