#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/compensation/rig/rig_fixture.h"

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

ChamberAir resting() { return ChamberAir(ChamberPhysics{}); }  // stopped, 23 degC

/// Amplitude of the line at f_hz in axis z [deg/s].
double line_dps(const std::vector<RigSample>& samples, double f_hz, double lsb_per_dps) {
  double real = 0.0, imaginary = 0.0;
  for (const RigSample& s : samples) {
    const double angle = 2.0 * 3.14159265358979323846 * f_hz * static_cast<double>(s.t_ns) * 1e-9;
    real += s.gyro_lsb[2] * std::cos(angle);
    imaginary += s.gyro_lsb[2] * std::sin(angle);
  }
  return 2.0 * std::hypot(real, imaginary) / static_cast<double>(samples.size()) / lsb_per_dps;
}

double deviation_dps(const std::vector<RigSample>& samples, double lsb_per_dps) {
  double sum = 0.0, square = 0.0;
  for (const RigSample& s : samples) {
    sum += s.gyro_lsb[2];
    square += static_cast<double>(s.gyro_lsb[2]) * s.gyro_lsb[2];
  }
  const auto n = static_cast<double>(samples.size());
  return std::sqrt(square / n - sum * sum / n / n) / lsb_per_dps;
}

}  // namespace

TEST_CASE("lines appear at the aliases of the fact sheet") {
  CHECK(alias_hz(24.5, 50.0) == Approx(24.5));
  CHECK(alias_hz(29.2, 50.0) == Approx(20.8));
  CHECK(alias_hz(49.0, 50.0) == Approx(1.0));
  CHECK(alias_hz(58.3, 50.0) == Approx(8.3));
  CHECK(alias_hz(120.0, 50.0) == Approx(20.0));
}

TEST_CASE("the compressor's line is there while the air cools and only then, on every board") {
  const RigModel model = with(silent_rig(), use("compressor_vibration", "line_and_step",
                                                {{"a", 20.0}, {"f", 49.0}, {"v", 10.0}}));
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{23.0});  // cycling: rises until 105 s, falls until 315 s
  const auto cooling = samples_of(model, air, 150.0, 5000);
  const auto heating = samples_of(model, air, 330.0, 4000);
  CHECK(line_dps(cooling, 49.0, 30000.0) == Approx(0.020).epsilon(0.02));
  CHECK(line_dps(heating, 49.0, 30000.0) < 0.001);
  const auto other = samples_of(model, air, 150.0, 5000, 50.0, 1);
  for (std::size_t i = 1; i < 100; ++i) {  // the same phase: boards differ by a constant
    CHECK(std::abs((cooling[i].gyro_lsb[2] - cooling[i - 1].gyro_lsb[2]) -
                   (other[i].gyro_lsb[2] - other[i - 1].gyro_lsb[2])) <= 2);
  }
}

TEST_CASE("50 Hz mains sampled at 50 Hz is slow wander, at 47 Hz a line of 3 Hz") {
  const RigModel model = with(
      silent_rig(), use("mains_hum", "steady", {{"a", 20.0}, {"clock", 100.0}, {"second", 0.0}}));
  const auto at_50 = samples_of(model, resting(), 0.0, 50 * 400);  // two periods of 200 s
  const auto at_47 = samples_of(model, resting(), 0.0, 47 * 400, 47.0);
  CHECK(line_dps(at_50, 0.005, 30000.0) == Approx(0.020).epsilon(0.02));
  CHECK(line_dps(at_47, 3.0 - 0.005, 30000.0) == Approx(0.020).epsilon(0.02));
  const RigModel wandering = with(silent_rig(), use("mains_hum", "wandering", {{"a", 20.0}}));
  CHECK(deviation_dps(samples_of(wandering, resting(), 0.0, 60000), 30000.0) ==
        Approx(0.020 * std::sqrt((1.0 + 0.09) / 2.0)).epsilon(0.2));
}

TEST_CASE("telegraph noise has two levels, their dwell times and their Lorentzian's variance") {
  const EffectUse switching =
      use("random_telegraph_noise", "two_levels", {{"a", 100.0}, {"low", 1.0}, {"high", 3.0}});
  const auto samples = samples_of(with(silent_rig(), switching), resting(), 0.0, 500'000);
  std::set<int> levels;
  int high = 0, switches = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    levels.insert(samples[i].gyro_lsb[2]);
    high += samples[i].gyro_lsb[2] == *levels.rbegin();
    switches += i > 0 && samples[i].gyro_lsb[2] != samples[i - 1].gyro_lsb[2];
  }
  REQUIRE(levels.size() == 2);
  CHECK(*levels.rbegin() - *levels.begin() == Approx(3000).margin(1));
  CHECK(high / 500'000.0 == Approx(0.75).margin(0.02));
  CHECK(10'000.0 / (switches / 2.0) == Approx(4.0).epsilon(0.08));  // a cycle takes 1 s + 3 s
  Drivers hot;
  hot.die_c = 50.0;
  const Law& law = law_of("random_telegraph_noise", "two_levels");
  const Telegraph faster = law.telegraph(std::vector<double>{100.0, 1.0, 3.0, 0.5}, hot);
  CHECK(faster.low_dwell_s == Approx(std::exp(-0.5 / 8.617333262e-5 * (1 / 293.15 - 1 / 323.15))));
}

TEST_CASE("noise_temperature_dependence changes the spread with temperature, not the mean") {
  RigModel model = silent_rig();
  model.baseline.noise_dps = 0.1;
  model.baseline.lsb_per_dps = 20000.0;
  model.effects.push_back(use("noise_temperature_dependence", "exponential", {{"s1", 1.0}}));
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{50.0});
  CHECK(deviation_dps(samples_of(model, air, 7200.0, 100'000), 20000.0) ==
        Approx(0.1 * std::exp(0.3)).epsilon(0.02));
}

TEST_CASE("missing codes never come out and their neighbours take what they had") {
  RigModel model;
  model.baseline.noise_dps = 1.31;
  model.effects.push_back(use("missing_codes", "periodic", {{"share", 0.125}, {"phase", 1.0}}));
  const auto samples = samples_of(model, resting(), 0.0, 50'000);
  std::set<int> seen;
  for (const RigSample& s : samples) {
    CHECK(((s.gyro_lsb[2] % 8) + 8) % 8 != 1);
    seen.insert(s.gyro_lsb[2]);
  }
  CHECK(seen.contains(16));
  CHECK(seen.contains(18));
  const Law& single = law_of("missing_codes", "single");
  const std::vector<double> code_17{17.0};
  CHECK(single.code(code_17, 16.8, 17.0, 0.2) == 16.0);
  CHECK(single.code(code_17, 17.2, 17.0, 0.2) == 18.0);
  CHECK(single.code(code_17, 18.2, 18.0, 0.2) == 18.0);
}

TEST_CASE("saturation piles up at the rail") {
  RigModel model;
  model.effects.push_back(use("saturation", "upper", {{"hi", 5.0}}));
  const auto samples = samples_of(model, resting(), 0.0, 20'000);
  const int rail = static_cast<int>(std::lround(5.0 * 4.13));
  int at_rail = 0;
  for (const RigSample& s : samples) {
    CHECK(s.gyro_lsb[2] <= rail);
    at_rail += s.gyro_lsb[2] == rail;
  }
  const double above = 0.5 * std::erfc(((rail - 0.5) / 4.13 - 4.111) / 1.31 / std::sqrt(2.0));
  CHECK(at_rail / 20'000.0 == Approx(above).epsilon(0.05));
}

TEST_CASE("glitches are rare, alone and large") {
  RigModel model;
  model.effects.push_back(use("outlier_glitches", "one_sided", {{"p", 1e-3}, {"size", 30.0}}));
  const auto samples = samples_of(model, resting(), 0.0, 200'000);
  int glitches = 0;
  for (const RigSample& s : samples) glitches += s.gyro_lsb[2] > (4.1 + 10.0 * 1.31) * 4.13;
  CHECK(std::abs(glitches - 200) < 5 * std::sqrt(200));
}

TEST_CASE("stuck samples repeat on all axes at once while the counter goes on") {
  RigModel model;
  model.baseline.noise_dps = 20.0;  // no two equal by chance
  model.effects.push_back(use("stuck_samples", "runs", {{"share", 0.05}, {"length", 20.0}}));
  const auto samples = samples_of(model, resting(), 0.0, 200'000);
  int repeats = 0, not_together = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    int equal = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      equal += samples[i].gyro_lsb[axis] == samples[i - 1].gyro_lsb[axis];
    }
    repeats += equal == 3;
    not_together += equal == 2;
  }
  CHECK(repeats / 200'000.0 == Approx(0.05).epsilon(0.12));
  CHECK(not_together < 30);  // two of three by chance: 7
}

TEST_CASE("dropped samples: the share that is asked, in bursts or alone") {
  for (const auto& [law, burst] : {std::pair{"bursts", 10.0}, std::pair{"independent", 1.0}}) {
    CAPTURE(law);
    RigModel model;
    model.effects.push_back(use("dropped_samples", law, {{"share", 0.02}}));
    const auto samples = samples_of(model, resting(), 0.0, 500'000);
    int lost = 0, gaps = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      lost += samples[i].lost;
      gaps += samples[i].lost && !samples[i - 1].lost;
    }
    CHECK(lost / 500'000.0 == Approx(0.02).epsilon(0.12));
    CHECK(static_cast<double>(lost) / gaps == Approx(burst).epsilon(0.1));
  }
}

TEST_CASE("an effect is felt by the axes and boards it names, and disturbs no other's noise") {
  RigModel plain;
  RigModel model = plain;
  model.effects.push_back(use("bias_instability", "flicker", {{"b", 500.0}}));
  model.effects[0].axes = {false, false, true};
  model.effects[0].boards = {1};
  const auto same = samples_of(model, resting(), 10.0, 1000, 50.0, 0);
  CHECK(same == samples_of(plain, resting(), 10.0, 1000, 50.0, 0));
  const auto felt = samples_of(model, resting(), 10.0, 1000, 50.0, 1);
  const auto without = samples_of(plain, resting(), 10.0, 1000, 50.0, 1);
  int different_z = 0;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    CHECK(felt[i].gyro_lsb[0] == without[i].gyro_lsb[0]);
    different_z += felt[i].gyro_lsb[2] != without[i].gyro_lsb[2];
  }
  CHECK(different_z > 0);
}
