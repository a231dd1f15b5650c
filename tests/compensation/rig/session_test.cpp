#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/rig/driver_track.h"
#include "compensation/rig/empirical_term.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/rig/rig_fixture.h"

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

SessionPlan short_plan() {
  SessionPlan plan;
  plan.setpoints_c = {-10.0, 10.0, 30.0};
  plan.soak_s = 600.0;
  plan.samples_per_dwell = 500;
  return plan;
}

bool same_bits(const Session& a, const Session& b) {
  if (a.monitor.size() != b.monitor.size() || a.samples.size() != b.samples.size()) return false;
  for (std::size_t i = 0; i < a.monitor.size(); ++i) {
    if (a.monitor[i].gyro_dps != b.monitor[i].gyro_dps) return false;
  }
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    if (a.samples[i].gyro_dps != b.samples[i].gyro_dps) return false;
    if (a.samples[i].acc_g != b.samples[i].acc_g) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the paper's plan takes the ten and a half hours that its steps add up to") {
  const SessionPlan plan;
  const Schedule made = schedule(plan, ChamberPhysics{}, 1);
  REQUIRE(made.dwells.size() == 25);
  // 25 x (20 + 1) min, 60 degC up at 1 and 33 down at 0.7 degC/min, the last degree of each slower
  CHECK(made.end_s / 3600.0 == Approx(8.75 + 1.0 + 33.0 / 0.7 / 60.0).margin(0.5));
  CHECK(made.dwells.back().setpoint_c == 50.0);
}

TEST_CASE("sweeps visit what they say") {
  SessionPlan plan;
  plan.setpoints_c = {0.0, 10.0, 20.0};
  plan.revisits_c = {0.0};
  CHECK(visits_c(plan, 1) == std::vector<double>{0.0, 10.0, 20.0, 0.0});
  plan.sweep = Sweep::up_down;
  CHECK(visits_c(plan, 1) == std::vector<double>{0.0, 10.0, 20.0, 10.0, 0.0, 0.0});
  plan = SessionPlan{};
  plan.sweep = Sweep::shuffled;
  auto shuffled = visits_c(plan, 7);
  CHECK(shuffled == visits_c(plan, 7));
  CHECK(shuffled != visits_c(plan, 8));
  std::sort(shuffled.begin(), shuffled.end());
  CHECK(shuffled == paper_setpoints_c());
}

TEST_CASE("the same seed gives the same session, another seed another") {
  const RigModel model;
  const Session first = simulate_session(model, short_plan(), 5);
  CHECK(same_bits(first, simulate_session(model, short_plan(), 5)));
  CHECK_FALSE(same_bits(first, simulate_session(model, short_plan(), 6)));
}

TEST_CASE("dwells hold their samples at full rate, the monitor covers the whole campaign") {
  const Session session = simulate_session(RigModel{}, short_plan(), 1);
  REQUIRE(session.dwells.size() == 3);
  REQUIRE(session.samples.size() == 3 * 500);
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    const SessionSample& s = session.samples[i];
    CHECK(s.dwell == static_cast<std::int32_t>(i / 500));
    CHECK(s.seq == static_cast<std::int64_t>(i % 500));
    CHECK(s.t_s == Approx(session.dwells[i / 500].t_start_s + 0.02 * static_cast<double>(i % 500)));
    CHECK(std::abs(s.gyro_dps * 4.13 - std::round(s.gyro_dps * 4.13)) < 1e-9);
  }
  CHECK(session.monitor.front().t_s == 2.5);
  CHECK(session.monitor.back().t_s + 5.0 >= session.samples.back().t_s);
}

TEST_CASE("lost frames leave holes in seq and thinner monitor rows") {
  const RigModel model = with(RigModel{}, use("dropped_samples", "independent", {{"share", 0.1}}));
  const Session session = simulate_session(model, short_plan(), 1);
  CHECK(session.samples.size() == Approx(1350).margin(60));
  CHECK(session.samples.back().seq <= 499);
}

TEST_CASE("a power cycle in the plan starts self-heating anew") {
  RigModel model = with(silent_rig(), use("self_heating", "direct", {{"a", 0.2}, {"tau", 100.0}}));
  SessionPlan plan = short_plan();
  const Session plain = simulate_session(model, plan, 1);
  plan.power_cycle_before = 1;
  const Session cycled = simulate_session(model, plan, 1);
  double most = 0.0;
  for (std::size_t i = 0; i < plain.monitor.size(); ++i) {
    most = std::max(most, std::abs(cycled.monitor[i].gyro_dps - plain.monitor[i].gyro_dps));
  }
  CHECK(most == Approx(0.2).epsilon(0.05));
}

TEST_CASE("board and die tracked from the chamber's record predict a silent session") {
  const RigModel model = silent_rig();
  const Session session = simulate_session(model, short_plan(), 1);
  const auto drivers = track_drivers(session.monitor, 240.0, 40.0);
  REQUIRE(drivers.size() == session.monitor.size());
  for (std::size_t i = 0; i < drivers.size(); ++i) {
    CHECK(std::abs(session.monitor[i].gyro_dps - model.baseline.bias[2].at(drivers[i].die_c)) <
          2e-4);
    CHECK(std::abs(session.monitor[i].board_c - drivers[i].board_c) <= 0.25 + 0.05);
  }
}

TEST_CASE(
    "without a chamber column the board stands for the air, without either there is nothing") {
  Session session = simulate_session(silent_rig(), short_plan(), 1);
  for (MonitorRow& row : session.monitor) row.chamber_c = missing;
  const auto drivers = track_drivers(session.monitor, 240.0, 40.0);
  CHECK(drivers[700].board_c == session.monitor[700].board_c);
  CHECK(std::abs(drivers[700].die_c - drivers[700].board_c) < 2.0);
  for (MonitorRow& row : session.monitor) row.board_c = missing;
  CHECK(track_drivers(session.monitor, 240.0, 40.0).empty());
}

TEST_CASE("a plan that cannot be run is refused with what is allowed") {
  SessionPlan plan;
  plan.setpoints_c = {};
  CHECK(check(plan).error().code == Errc::too_few_points);
  plan.setpoints_c = {std::nan("")};
  CHECK(check(plan).error().code == Errc::not_finite);
  plan.setpoints_c = {500.0};
  CHECK(check(plan).error().advice == "allowed: -70..150");
  plan = SessionPlan{};
  plan.sample_rate_hz = -1.0;
  CHECK(check(plan).error().code == Errc::out_of_range);
}

TEST_CASE("an unexplained term is simulated as its curve says") {
  RigModel model = silent_rig();
  model.unexplained = {
      {EmpiricalDriver::die, 0.0, {0.0, 20.0, 30.0}, {0.0, 0.1, 0.0}, {true, true, true}}};
  Drivers now;
  now.die_c = 10.0;
  CHECK(drift_dps(model.unexplained[0], now) == Approx(0.05));
  now.die_c = -50.0;
  CHECK(drift_dps(model.unexplained[0], now) == 0.0);
  now.die_c = 25.0;
  CHECK(drift_dps(model.unexplained[0], now) == Approx(0.05));
  const auto samples = samples_of(model, ChamberAir(ChamberPhysics{}), 0.0, 1);
  CHECK(samples[0].gyro_lsb[2] / 30000.0 ==
        Approx(model.baseline.bias[2].at(23.0) + 0.07).margin(2e-5));
}
