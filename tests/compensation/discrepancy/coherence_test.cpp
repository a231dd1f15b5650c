#include "compensation/discrepancy/coherence.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

namespace {

AxisDiagnosis axis_with(const std::string& board, const std::string& axis,
                        const std::vector<Finding>& findings) {
  AxisDiagnosis one{board, axis, {}};
  one.diagnosis.findings = findings;
  one.diagnosis.detection_limits = {{"condensation_step", 0.003},
                                    {"bias_jump", 0.002},
                                    {"mode_crossing", 0.002},
                                    {"mains_hum", 2}};
  return one;
}

Finding finding(const std::string& effect, double amplitude, double t0_s = 0) {
  Finding made;
  made.effect = effect;
  made.amplitude = amplitude;
  if (t0_s > 0) made.parameters = {{"a", amplitude}, {"t0", t0_s}};
  return made;
}

}  // namespace

TEST_CASE(
    "what every board shows comes from the environment, what one axis shows from the device") {
  const std::vector<AxisDiagnosis> all{
      axis_with("A", "x", {finding("condensation_step", 0.02)}),
      axis_with("A", "z", {finding("condensation_step", 0.03), finding("mode_crossing", 0.01)}),
      axis_with("B", "x", {finding("condensation_step", 0.02)}),
      axis_with("B", "z", {finding("condensation_step", 0.01)})};
  const auto shared = compare_boards(all);
  REQUIRE(shared.size() == 2);
  CHECK(shared[0].effect == "condensation_step");
  CHECK(shared[0].origin == Origin::environment);
  CHECK(shared[0].seen_in == std::vector<std::string>{"A/x", "A/z", "B/x", "B/z"});
  CHECK(shared[1].origin == Origin::axis);
  CHECK(shared[1].absent_in == std::vector<std::string>{"A/x", "B/x", "B/z"});
}

TEST_CASE("two boards that jump at different times have two jumps, each its own") {
  const std::vector<AxisDiagnosis> all{axis_with("A", "z", {finding("bias_jump", 0.02, 10'000)}),
                                       axis_with("B", "z", {finding("bias_jump", 0.02, 20'000)})};
  const auto shared = compare_boards(all);
  REQUIRE(shared.size() == 2);
  CHECK(shared[0].origin == Origin::board);
  CHECK(shared[1].origin == Origin::board);
}

TEST_CASE("boards that jump at one instant were knocked together") {
  const std::vector<AxisDiagnosis> all{axis_with("A", "z", {finding("bias_jump", 0.02, 10'000)}),
                                       axis_with("B", "z", {finding("bias_jump", -0.01, 10'040)})};
  const auto shared = compare_boards(all);
  REQUIRE(shared.size() == 1);
  CHECK(shared[0].origin == Origin::environment);
}

TEST_CASE("a board that could not have shown it is no witness") {
  std::vector<AxisDiagnosis> all{axis_with("A", "z", {finding("mains_hum", 5)}),
                                 axis_with("B", "z", {})};
  all[1].diagnosis.detection_limits["mains_hum"] = 20;
  const auto shared = compare_boards(all);
  REQUIRE(shared.size() == 1);
  CHECK(shared[0].blind_in == std::vector<std::string>{"B/z"});
  CHECK(shared[0].origin == Origin::unclear);
}
