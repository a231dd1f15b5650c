#include "daemon/campaign/stability.h"

#include <catch2/catch.hpp>

namespace gyrocal::campaign {
namespace {

StabilityConfig limits() {
  StabilityConfig config;
  config.air_band = Kelvin{0.3};
  config.air_peak_to_peak = Kelvin{0.2};
  config.air_window_s = 600;
  config.board_slope_k_per_h = 2;
  config.board_window_s = 900;
  return config;
}

AirStability settled_air() {
  AirStability air(limits(), seconds(15));
  air.start(Celsius{20});
  for (int t = 0; t <= 600; t += 5) air.observe(seconds(t), Celsius{20.1});
  return air;
}

}  // namespace

SCENARIO("air is stable after a whole window in its band, not before") {
  AirStability air(limits(), seconds(15));
  air.start(Celsius{20});
  CHECK(air.verdict(seconds(0)) == Verdict::unstable);
  for (int t = 0; t < 600; t += 5) air.observe(seconds(t), Celsius{20.1});
  CHECK(air.verdict(seconds(595)) == Verdict::unstable);
  air.observe(seconds(600), Celsius{20.1});
  CHECK(air.verdict(seconds(600)) == Verdict::stable);
  CHECK(to_seconds(air.in_band()) == 600);
}

SCENARIO("leaving the band starts the timer again") {
  AirStability air = settled_air();
  air.observe(seconds(605), Celsius{20.31});
  CHECK(air.verdict(seconds(605)) == Verdict::unstable);
  CHECK(air.in_band() == Duration{});
  air.observe(seconds(610), Celsius{20.0});
  CHECK(air.verdict(seconds(610)) == Verdict::unstable);
}

SCENARIO("missing readings are unknown, never stable, and do not start the timer again") {
  AirStability air = settled_air();
  CHECK(air.verdict(seconds(615)) == Verdict::stable);
  CHECK(air.verdict(seconds(616)) == Verdict::unknown);
  air.observe(seconds(700), Celsius{20.1});
  CHECK(air.verdict(seconds(700)) == Verdict::stable);
}

SCENARIO("cycling within the band beyond the peak-to-peak limit is not stable") {
  AirStability air(limits(), seconds(15));
  air.start(Celsius{20});
  for (int i = 0; i <= 200; ++i) air.observe(seconds(5 * i), Celsius{i % 2 ? 20.15 : 19.9});
  CHECK(air.verdict(seconds(1000)) == Verdict::unstable);
  CHECK(air.peak_to_peak().value == Approx(0.25));
}

SCENARIO("a new setpoint forgets the old one") {
  AirStability air = settled_air();
  air.start(Celsius{20.1});
  CHECK(air.verdict(seconds(600)) == Verdict::unstable);
}

SCENARIO("a board is stable when its slope over the window is small") {
  BoardStability board(limits(), seconds(15));
  board.start();
  CHECK(board.verdict(seconds(0)) == Verdict::unknown);
  for (int t = 0; t <= 895; t += 5) board.observe(seconds(t), Celsius{20 + 1.5 * t / 3600});
  CHECK(board.verdict(seconds(895)) == Verdict::unstable);  // the window is not full
  board.observe(seconds(900), Celsius{20 + 1.5 * 900 / 3600});
  CHECK(board.verdict(seconds(900)) == Verdict::stable);
  REQUIRE(board.slope_k_per_h());
  CHECK(*board.slope_k_per_h() == Approx(1.5));
  CHECK(board.verdict(seconds(916)) == Verdict::unknown);
}

SCENARIO("one step of a coarse sensor inside the window is a slope") {
  BoardStability board(limits(), seconds(15));
  board.start();
  for (int t = 0; t <= 900; t += 5) board.observe(seconds(t), Celsius{t < 450 ? 20.0 : 20.5});
  CHECK(*board.slope_k_per_h() == Approx(3.0).epsilon(0.01));  // 1.5 steps a window
  CHECK(board.verdict(seconds(900)) == Verdict::unstable);
}

SCENARIO("a sensor of 0.5 K cannot show 2 K/h in 300 s, but can in 900 s") {
  CHECK(can_resolve_slope(board_sensor_step, 2.0, 900));
  CHECK_FALSE(can_resolve_slope(board_sensor_step, 2.0, 300));
  CHECK_FALSE(can_resolve_slope(board_sensor_step, 0.5, 900));
}

}  // namespace gyrocal::campaign
