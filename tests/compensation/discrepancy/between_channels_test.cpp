#include "compensation/discrepancy/between_channels.h"

#include <catch2/catch.hpp>

#include "compensation/rig/simulate_session.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

Finding finding(const char* effect, const char* law, double amplitude) {
  Finding made;
  made.effect = effect;
  made.law = law;
  made.amplitude = amplitude;
  made.evidence_nats = made.lead_nats = 40;
  return made;
}

/// Whether a window in temperature of that size stays, beside these codes missing.
bool window_stays(double counts, const std::vector<std::int64_t>& holes) {
  constexpr double lsb_dps = 0.05;
  std::vector<Finding> slow{finding("mode_crossing", "kink", -counts * lsb_dps)};
  std::vector<Finding> fast{finding("missing_codes", "single", 0.3)};
  CodeFindings codes;
  codes.holes = holes;
  settle_between_channels(slow, fast, codes, lsb_dps, true);
  return !slow.empty();
}

}  // namespace

TEST_CASE("codes missing in a row bend means by half of them, and no window is told for that") {
  CHECK_FALSE(window_stays(0.4, {74, 76, 88}));
  CHECK(window_stays(0.8, {74, 76, 88}));
  CHECK_FALSE(window_stays(0.8, {74, 76, 79, 80, 81, 82, 88}));
  CHECK(window_stays(2.2, {74, 76, 79, 80, 81, 82, 88}));
}

TEST_CASE("a board that reads warm may be what drifts") {
  const auto settled = [](double offset_c, double self_heating_nats) {
    std::vector<Finding> slow{finding("aging_drift", "logarithmic", -1.5)};
    slow[0].candidates = {{"aging_drift", "logarithmic", 40, ""},
                          {"self_heating", "warm_up", self_heating_nats, ""}};
    std::vector<Finding> fast{finding("board_sensor_offset", "offset", offset_c)};
    settle_between_channels(slow, fast, {}, 0.2, false);
    return std::pair{slow[0].confounded_with, fast.size()};
  };
  CHECK(settled(0.4, 33) == std::pair{std::vector<std::string>{"self_heating"}, std::size_t{0}});
  CHECK(settled(0.4, 20) == std::pair{std::vector<std::string>{}, std::size_t{1}});
  CHECK(settled(-0.4, 33) == std::pair{std::vector<std::string>{}, std::size_t{1}});
}

TEST_CASE("strong flicker is not told as a walk beside a faint telegraph") {
  rig::RigModel model = quiet_rig();
  model.baseline.noise_dps = 0.05;
  model.effects.push_back({"bias_instability", "flicker", {{"b", 27}}});
  const auto diagnosis = diagnose(rig::simulate_session(model, short_up_down(), 61), {}, {});
  REQUIRE(diagnosis.has_value());
  REQUIRE(diagnosis->findings.size() == 1);
  CHECK(diagnosis->findings[0].effect == "bias_instability");
}
