#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <thread>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

void check_told_as_unknown(const Session& session) {
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  CHECK(found->verdict == Verdict::unexplained);
  for (const Finding& finding : found->findings) CHECK(finding.effect == "unknown");
}

}  // namespace

TEST_CASE("a leak that grows by the hour and by the degree is told as unknown, not as a walk") {
  const Session quiet = quiet_session(11);
  const double end_s = quiet.monitor.back().t_s;
  check_told_as_unknown(with_warm_drift(quiet, [&](double t_s, double board_c, double) {
    return 0.1 * t_s / end_s * std::exp((board_c - 50) / 9);
  }));
}

TEST_CASE(
    "a drift with the square of the rate is told as unknown, not as a jump at the longest ramp") {
  check_told_as_unknown(
      with_warm_drift(quiet_session(11), [](double, double board_c, double chamber_c) {
        return 1.5e-3 * (chamber_c - board_c) * (chamber_c - board_c);
      }));
}

TEST_CASE("a drift that sweeps in frequency is told as unknown, not as a random walk") {
  check_told_as_unknown(with_drift(quiet_session(11), [](double t_s) {
    return 0.01 * std::sin(2 * std::numbers::pi * (1e-4 + 4e-9 * t_s) * t_s);
  }));
}

TEST_CASE(
    "pulses by the clock are told as unknown, not as a telegraph, noise cutting some in two") {
  const Session quiet = quiet_session(11);  // a row has 6 mdps of noise
  for (const double size_dps : {0.01, 0.007}) {
    CAPTURE(size_dps);
    check_told_as_unknown(with_drift(
        quiet, [&](double t_s) { return std::fmod(t_s, 2200.0) < 500 ? size_dps : 0.0; }));
  }
}

TEST_CASE("a random walk and flicker keep their names") {
  for (const auto& [effect, parameter, size] :
       {std::tuple{"rate_random_walk", "k", 0.2}, std::tuple{"bias_instability", "b", 30.0}}) {
    CAPTURE(effect);
    rig::RigModel model = quiet_rig();
    model.effects.push_back({effect, "", {{parameter, size}}});
    const auto found = diagnose(rig::simulate_session(model, short_up_down(), 12), {}, {});
    REQUIRE(found.has_value());
    REQUIRE(found->findings.size() == 1);
    CHECK(found->findings[0].effect == effect);
    CHECK(found->findings[0].amplitude == Approx(size).epsilon(0.3));
  }
}

TEST_CASE("white noise that grows with time is told as such, with its rate") {
  Session session = rig::simulate_session(quiet_rig(), short_up_down(), 13);
  rig::RigModel other = quiet_rig();
  // The second half of the campaign from a noisier rig of the same seed.
  other.baseline.noise_dps = 0.13;
  const Session noisy = rig::simulate_session(other, short_up_down(), 13);
  const double half_s = session.dwells[session.dwells.size() / 2].t_start_s;
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    if (session.samples[i].t_s > half_s) session.samples[i] = noisy.samples[i];
  }
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  REQUIRE(found->findings.size() == 1);
  CHECK(found->findings[0].law == "spread_over_time");
  CHECK(found->findings[0].amplitude > 0);
}

TEST_CASE("a board that slipped twice between dwells shows its g-sensitivity, not two jumps") {
  const double g_dps = 0.1, first_s = 17'345, second_s = 40'120;
  Session session = rig::simulate_session(quiet_rig(), short_up_down(), 14);
  const auto tilt = [&](double t_s) { return t_s < first_s ? 0.0 : t_s < second_s ? 0.2 : -0.12; };
  for (MonitorRow& row : session.monitor) row.gyro_dps += g_dps * std::sin(tilt(row.t_s));
  for (SessionSample& sample : session.samples) {
    sample.gyro_dps += g_dps * std::sin(tilt(sample.t_s));
    sample.acc_g = {std::sin(tilt(sample.t_s)), 0.0, std::cos(tilt(sample.t_s))};
  }
  const auto found = diagnose(session, {}, {});
  REQUIRE(found.has_value());
  REQUIRE(found->findings.size() == 1);
  CHECK(found->findings[0].effect == "g_sensitivity");
  CHECK(found->findings[0].amplitude == Approx(g_dps).epsilon(0.05));
}

TEST_CASE("the answer does not depend on who shares out the work") {
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    std::thread other([&] {
      for (std::size_t i = count; i-- > count / 2;) task(i);
    });
    for (std::size_t i = 0; i < count / 2; ++i) task(i);
    other.join();
  };
  rig::RigModel model = quiet_rig();
  model.effects.push_back({"thermal_hysteresis", "play", {{"h", 0.02}, {"w", 2.5}}});
  const Session session = rig::simulate_session(model, short_up_down(), 15);
  const auto alone = diagnose(session, {}, {});
  const auto shared = diagnose(session, {}, {.run_all = backwards});
  REQUIRE(alone.has_value());
  REQUIRE(shared.has_value());
  REQUIRE(shared->findings.size() == alone->findings.size());
  CHECK(shared->findings[0].parameters == alone->findings[0].parameters);
  CHECK(shared->gap.after == alone->gap.after);
}
