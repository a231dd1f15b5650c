#include "compensation/discrepancy/sample_rows.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compensation/discrepancy/diagnosis.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

Session without_stream(const rig::EffectUse* hidden, std::uint64_t seed) {
  rig::RigModel model = quiet_rig();
  if (hidden != nullptr) model.effects.push_back(*hidden);
  rig::SessionPlan plan = short_up_down();
  plan.samples_per_dwell = 3000;
  Session session = rig::simulate_session(model, plan, seed);
  session.monitor.clear();
  return session;
}

}  // namespace

TEST_CASE("rows of a second hold the means of its samples") {
  Session session;
  session.sample_rate_hz = 10;
  session.monitor_interval_s = 5;
  session.dwells = {{4, 30.0, 100}, {5, 32.0, 1000}};
  for (const int dwell : {4, 5}) {
    for (int i = 0; i < 404; ++i) {
      const double t_s = (dwell == 4 ? 100 : 1000) + i / 10.0;
      session.samples.push_back({dwell, i, t_s, double(i / 10), {}, 30.5, 26.0 + dwell});
    }
  }
  session.samples[3].gyro_dps = missing;
  const Session made = with_rows_of_samples(session);
  CHECK(made.monitor_interval_s == 1);
  // The whole seconds of each dwell, and between them where the air is taken to have got to.
  REQUIRE(made.monitor.size() == 81);
  CHECK(rows_with_gyro(made) == 80);
  CHECK(made.monitor[0].t_s == Approx(100.5));
  CHECK(made.monitor[1].gyro_dps == 1);
  CHECK(made.monitor[1].setpoint_c == 30);
  CHECK(made.monitor[40].t_s == Approx((139.5 + 1000.5) / 2));
  CHECK(std::isnan(made.monitor[40].gyro_dps));
  CHECK(made.monitor[40].chamber_c == 31);
  CHECK(made.monitor[80].chamber_c == 31);
  CHECK(made.monitor[80].board_c == 30.5);
}

TEST_CASE("without a slow stream the samples are judged: nothing hidden, nothing said") {
  const auto diagnosis = diagnose(without_stream(nullptr, 51), {}, {});
  REQUIRE(diagnosis.has_value());
  CHECK(diagnosis->verdict == Verdict::consistent);
  // What the air did between the dwells is guessed: no measure of the board's sensor.
  CHECK(diagnosis->detection_limits.count("board_sensor_offset") == 0);
  CHECK(std::any_of(diagnosis->notes.begin(), diagnosis->notes.end(), [](const std::string& note) {
    return note.find("monitor.csv has 0 rows") == 0;
  }));
}

TEST_CASE("half a minute of samples is enough to say that nothing shows") {
  Session session = without_stream(nullptr, 54);
  session.dwells.resize(1);
  session.samples.resize(1500);
  const auto diagnosis = diagnose(session, {}, {});
  REQUIRE(diagnosis.has_value());
  CHECK(diagnosis->verdict == Verdict::consistent);
}

TEST_CASE("without a slow stream what dwells show is still named") {
  const rig::EffectUse hidden{"bias_jump", "step", {{"a", 0.05}, {"t0", 30000}}};
  const auto diagnosis = diagnose(without_stream(&hidden, 52), {}, {});
  REQUIRE(diagnosis.has_value());
  REQUIRE(diagnosis->findings.size() == 1);
  CHECK(diagnosis->findings[0].effect == "bias_jump");
  CHECK(diagnosis->findings[0].amplitude == Approx(0.05).epsilon(0.1));
}

TEST_CASE("a session with neither is refused") {
  Session session = without_stream(nullptr, 53);
  session.dwells.resize(1);
  session.samples.resize(100);  // two seconds
  const auto diagnosis = diagnose(session, {}, {});
  REQUIRE_FALSE(diagnosis.has_value());
  CHECK(diagnosis.error().code == Errc::too_few_points);
  CHECK(diagnosis.error().what.find("expected at least 32") != std::string::npos);
}
