#include "compensation/rig/rig_board.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {

constexpr std::int64_t second = 1'000'000'000;

ChamberAir going_to(double setpoint_c) {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{setpoint_c});
  return air;
}

}  // namespace

TEST_CASE("the same seed gives the same samples however the time is cut") {
  const RigModel model;
  const auto seed = GENERATE(range(0u, 5u));
  const double rate_hz = GENERATE(1.0, 30.0, 50.0, 400.0);
  CAPTURE(seed, rate_hz);
  const ChamberAir air = going_to(-10.0);
  std::vector<RigSample> at_once;
  RigBoard board(model, seed, 1);
  board.start(3 * second + 7, rate_hz);
  board.take(air, 2000, at_once);
  std::vector<RigSample> in_pieces;
  RigBoard cut(model, seed, 1);
  cut.advance(air, 2 * second);
  cut.start(3 * second + 7, rate_hz);
  std::srand(seed);
  while (in_pieces.size() < 2000) {
    if (std::rand() % 2 == 0) {
      cut.take(air, std::rand() % 37, in_pieces);
    } else {
      cut.take_until(air, cut.next_sample_ns() + std::rand() % 900'000'000, in_pieces);
    }
  }
  in_pieces.resize(2000);
  CHECK(at_once == in_pieces);
}

TEST_CASE("samples come at the asked rate, the first at the start") {
  RigBoard board(RigModel{}, 1, 0);
  const ChamberAir air = going_to(20.0);
  std::vector<RigSample> samples;
  board.take_until(air, 4 * second, samples);
  CHECK(samples.empty());
  board.start(5 * second, 50.0);
  board.take_until(air, 6 * second, samples);
  REQUIRE(samples.size() == 51);
  CHECK(samples.front().t_ns == 5 * second);
  CHECK(samples.back().t_ns == 6 * second);
  CHECK(samples[1].t_ns - samples[0].t_ns == 20'000'000);
}

TEST_CASE("a settled board shows the paper's drift and noise in whole counts") {
  RigModel model;
  const ChamberAir air = going_to(20.0);
  RigBoard board(model, 3, 0);
  board.advance(air, 7200 * second);
  board.start(7200 * second, 50.0);
  std::vector<RigSample> samples;
  constexpr int n = 200'000;
  board.take(air, n, samples);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0.0, square = 0.0;
    for (const auto& s : samples) {
      const double dps = s.gyro_lsb[axis] / 4.13;
      sum += dps;
      square += dps * dps;
    }
    const double mean = sum / n;
    const double sigma = std::sqrt(square / n - mean * mean);
    CAPTURE(axis);
    CHECK(std::abs(mean - model.baseline.bias[axis].at(20.0)) < 5.0 * 1.31 / std::sqrt(n) + 0.001);
    const double with_rounding = std::sqrt(1.31 * 1.31 + 1.0 / 12.0 / 4.13 / 4.13);
    CHECK(std::abs(sigma - with_rounding) < 5.0 * 1.31 / std::sqrt(2.0 * n));
  }
}

TEST_CASE("the default z bias lies in the paper's range over -10..50 degC") {
  const CubicBias z = Baseline{}.bias[2];
  for (double t = -10.0; t <= 50.0; t += 0.5) {
    CHECK(z.at(t) > 4.04);
    CHECK(z.at(t) < 4.40);
    CHECK(z.slope(t) == Approx((z.at(t + 1e-4) - z.at(t - 1e-4)) / 2e-4).margin(1e-8));
  }
}

TEST_CASE("the board's sensor moves in steps of 0x80 and follows the board, not the air") {
  const ChamberAir air = going_to(-10.0);
  RigBoard board(RigModel{}, 1, 0);
  for (std::int64_t t = 0; t < 7200; t += 10) {
    const std::int16_t raw = board.temperature_raw(air, t * second);
    CHECK(raw % 0x80 == 0);
    CHECK(std::abs(raw / 256.0 - board.board_temperature().value) <= 0.25 + 1e-9);
  }
  CHECK(board.temperature_raw(air, 7200 * second) == -10 * 256);
}

TEST_CASE("board 0 has the bias as written, others scatter around it, each with its own noise") {
  const ChamberAir air = going_to(20.0);
  RigModel model;
  model.baseline.noise_dps = 0.0;
  model.baseline.lsb_per_dps = 4000.0;
  model.baseline.code_limit = 32000;
  std::vector<RigSample> samples;
  for (std::uint32_t index = 0; index < 2; ++index) {
    RigBoard board(model, 5, index);
    board.start(0, 50.0);
    board.take(air, 1, samples);
  }
  CHECK(samples[0].gyro_lsb[2] == std::lround(model.baseline.bias[2].at(23.0) * 4000.0));
  CHECK(samples[1].gyro_lsb[2] != samples[0].gyro_lsb[2]);
  CHECK(std::abs(samples[1].gyro_lsb[2] - samples[0].gyro_lsb[2]) < 5 * 0.05 * 4000);
}

TEST_CASE("a rate beyond the range is clipped at the ADC's last code") {
  RigModel model;
  model.baseline.bias[0].dps = {2000.0, 0.0, 0.0, 0.0};
  RigBoard board(model, 1, 0);
  board.start(0, 50.0);
  std::vector<RigSample> samples;
  board.take(going_to(20.0), 100, samples);
  for (const auto& s : samples) CHECK(s.gyro_lsb[0] == 4095);
}
