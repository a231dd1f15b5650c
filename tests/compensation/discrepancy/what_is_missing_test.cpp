#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

rig::RigModel rig_with_hysteresis() {
  rig::RigModel model = quiet_rig();
  model.baseline.board_sensor_step_c = 0.125;
  model.effects.push_back({"thermal_hysteresis", "play", {{"h", 0.02}, {"w", 2.5}}});
  return model;
}

Session session_of(const rig::SessionPlan& plan) {
  return rig::simulate_session(rig_with_hysteresis(), plan, 5);
}

bool says(const Diagnosis& diagnosis, const std::string& words) {
  return std::any_of(diagnosis.notes.begin(), diagnosis.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

bool cannot_see(const Diagnosis& diagnosis, const std::string& effect) {
  return std::count(diagnosis.not_observable.begin(), diagnosis.not_observable.end(), effect) == 1;
}

bool names_only_hysteresis(const Diagnosis& diagnosis) {
  return diagnosis.findings.size() == 1 && diagnosis.findings[0].effect == "thermal_hysteresis";
}

rig::SessionPlan up_down() {
  rig::SessionPlan plan;
  plan.sweep = rig::Sweep::up_down;
  plan.samples_per_dwell = 1000;
  return plan;
}

}  // namespace

TEST_CASE("without an accelerometer the rest is found and g_sensitivity is told as unseen") {
  Session session = session_of(up_down());
  for (SessionSample& sample : session.samples) sample.acc_g = {missing, missing, missing};
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(names_only_hysteresis(*found));
  CHECK(cannot_see(*found, "g_sensitivity"));
  CHECK(says(*found, "no accelerometer"));
}

TEST_CASE("without the chamber's column the board's stands in, and what that costs is said") {
  Session session = session_of(up_down());
  for (MonitorRow& row : session.monitor) row.chamber_c = missing;
  for (SessionSample& sample : session.samples) sample.chamber_c = missing;
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(says(*found, "no chamber column"));
  CHECK(cannot_see(*found, "board_sensor_offset"));
  CHECK_FALSE(found->findings.empty());
}

TEST_CASE("without the board's column its lag is the rig model's and its sensor unseen") {
  Session session = session_of(up_down());
  for (MonitorRow& row : session.monitor) row.board_c = missing;
  for (SessionSample& sample : session.samples) sample.board_c = missing;
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(names_only_hysteresis(*found));
  CHECK(cannot_see(*found, "board_sensor_offset"));
  CHECK(says(*found, "no board temperature"));
}

TEST_CASE("without any temperature the setpoints stand in, and that is said") {
  Session session = session_of(up_down());
  for (MonitorRow& row : session.monitor) row.board_c = row.chamber_c = missing;
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(says(*found, "neither chamber nor board temperature"));
}

TEST_CASE("a single dwell gives a verdict without a gap, and says so") {
  rig::SessionPlan plan;
  plan.setpoints_c = {25};
  plan.soak_s = 3600;
  rig::RigModel quiet = rig_with_hysteresis();
  quiet.effects.clear();
  const auto found = diagnose(rig::simulate_session(quiet, plan, 5), {}, {});
  REQUIRE(found.has_value());
  CHECK(found->verdict == Verdict::consistent);
  CHECK(found->gap.held_out_dwells.empty());
  CHECK(says(*found, "fewer than four dwells"));
}

TEST_CASE("two hundred dwells are diagnosed like twenty-five") {
  rig::SessionPlan plan;
  plan.setpoints_c.clear();
  for (int k = 0; k < 100; ++k) plan.setpoints_c.push_back(-10 + 60.0 * k / 99);
  plan.sweep = rig::Sweep::up_down;
  plan.soak_s = 300;
  plan.samples_per_dwell = 300;
  plan.sample_rate_hz = 25;
  const Session session = session_of(plan);
  REQUIRE(session.dwells.size() == 199);
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(names_only_hysteresis(*found));
  CHECK(found->gap.after < found->gap.before);
}

TEST_CASE("coarse, one-way and differently sampled plans are diagnosed") {
  rig::SessionPlan plan = up_down();
  SECTION("seven setpoints there and back") { plan.setpoints_c = {-10, 0, 10, 20, 30, 40, 50}; }
  SECTION("100 Hz, rows of two seconds") {
    plan.sample_rate_hz = 100;
    plan.monitor_interval_s = 2;
  }
  SECTION("12.5 Hz, rows of twenty seconds") {
    plan.sample_rate_hz = 12.5;
    plan.samples_per_dwell = 500;
    plan.monitor_interval_s = 20;
  }
  const auto found = diagnose(session_of(plan), {}, {});
  REQUIRE(found.has_value());
  CHECK(names_only_hysteresis(*found));
  CHECK(found->findings[0].amplitude == Approx(0.02).epsilon(0.1));
}

TEST_CASE("an hour without rows changes no name") {
  Session session = session_of(up_down());
  std::erase_if(session.monitor,
                [](const MonitorRow& row) { return row.t_s > 20'000 && row.t_s < 23'600; });
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(names_only_hysteresis(*found));
}

TEST_CASE("a film that formed in a kept-out segment is not told thicker than it was") {
  constexpr double thick_dps = 0.05;
  const double dew_c = GENERATE(6.5, 8.8);  // on the ramps to the kept-out 7.5 degC and from it
  CAPTURE(dew_c);
  rig::RigModel model = quiet_rig();
  model.effects.push_back(
      {"condensation_step",
       "film",
       {{"a", thick_dps}, {"t_dew", dew_c}, {"tau_on", 40}, {"tau_off", 1500}}});
  rig::SessionPlan plan;
  plan.samples_per_dwell = 1000;
  const auto diagnosis = diagnose(rig::simulate_session(model, plan, 71), {}, {});
  REQUIRE(diagnosis.has_value());
  REQUIRE(diagnosis->findings.size() == 1);
  CHECK(diagnosis->findings[0].effect == "condensation_step");
  CHECK(diagnosis->findings[0].amplitude > 0.25 * thick_dps);
  CHECK(diagnosis->findings[0].amplitude < 1.1 * thick_dps);
  CHECK(diagnosis->gap.after < diagnosis->gap.before + 0.2);
}
