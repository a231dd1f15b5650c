#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/rig/empirical_term.h"
#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

Session with_effect(const rig::EffectUse& use) {
  rig::RigModel model = quiet_rig();
  model.effects.push_back(use);
  return rig::simulate_session(model, short_up_down(), 21);
}

/// Diagnoses twice, the second time with the model that the first one made.
Diagnosis told_then_settled(const Session& session) {
  const auto first = diagnose(session, {}, {});
  REQUIRE(first.has_value());
  const auto second = diagnose(session, first->model, {});
  REQUIRE(second.has_value());
  CAPTURE(to_text(first->verdict));
  for (const Finding& finding : second->findings) UNSCOPED_INFO(finding.description);
  CHECK(second->verdict == Verdict::consistent);
  return *first;
}

}  // namespace

TEST_CASE("a named effect is in the model of the second run") {
  const auto [effect, law, parameter, size] =
      GENERATE(table<const char*, const char*, const char*, double>(
          {{"thermal_hysteresis", "play", "h", 0.02},
           {"self_heating", "", "dt", 3.0},
           {"bias_jump", "", "a", 0.03},
           {"rate_random_walk", "", "k", 0.2},
           {"compressor_vibration", "line_and_step", "a", 30.0},
           {"outlier_glitches", "", "p", 1e-3}}));
  CAPTURE(effect);
  const auto session = with_effect({effect, law, {{parameter, size}}});
  CHECK(told_then_settled(session).verdict == Verdict::explained);
}

TEST_CASE("a drift with a time scale of its own is kept as a term over time") {
  const auto first = told_then_settled(with_drift(quiet_session(21), [](double t_s) {
    return 0.01 * std::sin(2 * std::numbers::pi * (1e-4 + 4e-9 * t_s) * t_s);
  }));
  CHECK(first.verdict == Verdict::unexplained);
  REQUIRE_FALSE(first.model.unexplained.empty());
  CHECK(first.model.unexplained[0].driver == rig::EmpiricalDriver::campaign_time);
}

TEST_CASE("a curve over temperature is kept with its fitted size") {
  rig::RigModel model = quiet_rig();
  rig::EmpiricalTerm wave;
  for (double t_c = -15; t_c <= 55; t_c += 1) {
    wave.at.push_back(t_c);
    wave.dps.push_back(0.02 * std::sin(2 * std::numbers::pi * t_c / 11));
  }
  model.unexplained = {wave};
  const auto first = told_then_settled(rig::simulate_session(model, short_up_down(), 21));
  CHECK(first.verdict == Verdict::unexplained);
  REQUIRE_FALSE(first.model.unexplained.empty());
  rig::Drivers now;
  double low = 1, high = -1;
  for (now.die_c = 5; now.die_c < 35; now.die_c += 0.5) {
    const double dps = rig::drift_dps(first.model.unexplained[0], now);
    low = std::min(low, dps), high = std::max(high, dps);
  }
  CHECK(high - low == Approx(0.04).epsilon(0.2));
}

TEST_CASE("a line of no known machine is kept as a phase that turns with it") {
  const auto first = told_then_settled(with_drift(quiet_session(21), [](double t_s) {
    return 0.03 * std::sin(2 * std::numbers::pi * 13.7 * t_s);
  }));
  CHECK(first.verdict == Verdict::unexplained);
  REQUIRE(first.model.unexplained.size() == 1);
  CHECK(rig::is_line(first.model.unexplained[0]));
  CHECK(first.model.unexplained[0].period_s == Approx(1 / 13.7).epsilon(1e-3));
}

TEST_CASE("noise that grows by the hour is kept as a term of the noise") {
  rig::RigModel model = quiet_rig();
  rig::EmpiricalTerm growing;
  growing.driver = rig::EmpiricalDriver::campaign_time;
  growing.at = {0, 80'000};
  growing.noise_factor = {1, 1.6};
  model.unexplained = {growing};
  const auto first = told_then_settled(rig::simulate_session(model, short_up_down(), 21));
  CHECK(first.verdict == Verdict::unexplained);
  REQUIRE(first.model.unexplained.size() == 1);
  const auto& factor = first.model.unexplained[0].noise_factor;
  REQUIRE_FALSE(factor.empty());
  CHECK(factor.back() / factor.front() == Approx(1.6).epsilon(0.15));
}
