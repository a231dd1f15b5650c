#include "compensation/discrepancy/diagnosis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/discrepancy/segments.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

Session hysteresis_session() {
  rig::RigModel model = quiet_rig();
  model.effects.push_back({"thermal_hysteresis", "play", {{"h", 0.02}, {"w", 2.5}}});
  return rig::simulate_session(model, {}, 3);
}

}  // namespace

TEST_CASE("a session of the rig itself is consistent, with a limit beside each effect") {
  const auto seed = GENERATE(range(1u, 4u));
  CAPTURE(seed);
  const auto found = diagnose(rig::simulate_session(quiet_rig(), {}, seed), {}, {});
  REQUIRE(found.has_value());
  CHECK(found->verdict == Verdict::consistent);
  CHECK(found->findings.empty());
  CHECK(found->detection_limits.at("thermal_hysteresis") > 0);
  CHECK(found->gap.held_out_dwells == std::vector<int>{2, 7, 12, 17, 22});
}

TEST_CASE("a hidden hysteresis is named, measured, and gone once the model has it") {
  const Session session = hysteresis_session();
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(found->verdict == Verdict::explained);
  REQUIRE(found->findings.size() == 1);
  CHECK(found->findings[0].effect == "thermal_hysteresis");
  CHECK(found->findings[0].amplitude == Approx(0.02).epsilon(0.05));
  CHECK(found->findings[0].lead_nats > 5);
  CHECK(found->gap.slow_dps.after < 0.2 * found->gap.slow_dps.before);

  const auto again = diagnose(session, found->model, {});
  REQUIRE(again.has_value());
  CHECK(again->verdict == Verdict::consistent);
}

TEST_CASE("changing kept-out data changes no name and no parameter") {
  Session session = hysteresis_session();
  const auto before = diagnose(session, {}, {});
  const auto segments = split_segments(session);
  for (MonitorRow& row : session.monitor) {
    if (is_held_out(segments, row.t_s)) row.gyro_dps += 0.5;
  }
  for (SessionSample& sample : session.samples) {
    if (is_held_out(segments, sample.t_s)) sample.gyro_dps += 0.5;
  }
  const auto after = diagnose(session, {}, {});
  REQUIRE(before.has_value());
  REQUIRE(after.has_value());
  REQUIRE(after->findings.size() == before->findings.size());
  CHECK(after->findings[0].parameters == before->findings[0].parameters);
  CHECK(after->gap.after > before->gap.after);
}

TEST_CASE("a session no verdict can be given on is refused with the row and what was expected") {
  Session session = hysteresis_session();
  SECTION("no dwells") {
    session.dwells.clear();
    CHECK(diagnose(session, {}, {}).error().what == "session.json: no dwells");
  }
  SECTION("time runs backwards") {
    session.monitor[10].t_s = session.monitor[8].t_s;
    CHECK(diagnose(session, {}, {}).error().what.find("monitor.csv:12: t_s is") == 0);
  }
  SECTION("a dwell outside the record") {
    session.dwells.back().t_start_s = 1e6;
    CHECK(diagnose(session, {}, {}).error().what.find("outside the record") != std::string::npos);
  }
  SECTION("radians per second") {
    for (SessionSample& sample : session.samples) sample.gyro_dps /= 57.29577951308232;
    CHECK(diagnose(session, {}, {}).error().what.find("radians") != std::string::npos);
  }
  SECTION("an unknown effect in the rig model") {
    rig::RigModel model;
    model.effects.push_back({"gremlins"});
    CHECK(diagnose(session, model, {}).error().code == Errc::unknown_name);
  }
}
