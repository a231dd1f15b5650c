#include "tests/hidden_effects/thermal.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using hidden::Chain;
using hidden::Plan;
using hidden::Random;

namespace {

Plan one_step(double from_c, double to_c) {
  Plan plan;
  plan.kind = "step";
  plan.start_c = from_c;
  plan.setpoints_c = {to_c};
  plan.ramp_up_c_per_min = 1.0;
  return plan;
}

Chain still() {
  Chain chain;
  chain.ripple_c = 0.0;
  return chain;
}

}  // namespace

TEST_CASE("on a ramp the board and the die follow the closed solution of two poles") {
  const Chain chain = still();
  Random random(1);
  const auto over = hidden::simulate_temperatures(one_step(0.0, 40.0), chain, 60.0, random);
  const double r = 1.0 / 60.0;
  const double b = chain.board_tau_s;
  const double d = chain.die_tau_s;
  for (double t : {10.0, 100.0, 600.0, 1500.0, 2200.0}) {  // still at full slope
    const auto i = static_cast<std::size_t>(t);
    INFO(t << " s");
    CHECK(over.air_c[i] == Approx(r * t).margin(1e-9));
    CHECK(over.board_c[i] == Approx(r * (t - b * (1.0 - std::exp(-t / b)))).margin(1e-7));
    const double die =
        r * (t - b - d + (b * b * std::exp(-t / b) - d * d * std::exp(-t / d)) / (b - d));
    CHECK(over.die_c[i] == Approx(die).margin(1e-7));
    CHECK(over.rate_c_per_min[i] ==
          Approx(60.0 * r * (1.0 - (b * std::exp(-t / b) - d * std::exp(-t / d)) / (b - d)))
              .margin(1e-6));
  }
}

TEST_CASE("own heat arrives as two exponentials and shows on the board only in part") {
  Chain chain = still();
  chain.self_heat_c = 2.0;
  chain.self_heat_s = 300.0;
  Random random(1);
  const auto over = hidden::simulate_temperatures(one_step(20.0, 20.0), chain, 60.0, random);
  const double t = 700.0;
  const double warm =
      2.0 * (0.8 * (1.0 - std::exp(-t / 300.0)) + 0.2 * (1.0 - std::exp(-t / 1200.0)));
  CHECK(over.felt_c[700] == Approx(20.0 + warm).margin(1e-7));
  CHECK(over.board_c[700] == Approx(20.0 + 0.2 * warm).margin(1e-7));
  CHECK(over.die_c[700] == Approx(20.0).margin(1e-9));
}

TEST_CASE("an extra lag delays a steady ramp by its time") {
  Chain chain = still();
  chain.extra_lag_s = 120.0;
  Random random(1);
  const auto over = hidden::simulate_temperatures(one_step(0.0, 40.0), chain, 60.0, random);
  CHECK(over.die_c[2200] - over.felt_c[2200] == Approx(120.0 / 60.0).epsilon(0.01));
}

TEST_CASE(
    "a default campaign dwells at every setpoint after a full soak, within the chamber's ripple") {
  Random random(4);
  const Plan plan = hidden::make_plan("up_down", random);
  REQUIRE(plan.setpoints_c.size() == 49);
  const auto over = hidden::simulate_temperatures(plan, Chain{}, 60.0, random);
  REQUIRE(over.dwells.size() == 49);
  CHECK(static_cast<double>(over.seconds()) / 3600.0 == Approx(20.5).margin(1.5));
  for (const auto& dwell : over.dwells) {
    for (double t = dwell.start_s; t < dwell.start_s + 60.0; t += 1.0) {
      CHECK(std::abs(over.air_c[static_cast<std::size_t>(t)] - dwell.setpoint_c) < 0.25);
    }
  }
  const double slope_max =
      *std::max_element(over.rate_c_per_min.begin(), over.rate_c_per_min.end());
  const double slope_min =
      *std::min_element(over.rate_c_per_min.begin(), over.rate_c_per_min.end());
  CHECK(slope_max < 1.1);
  CHECK(slope_min > -0.8);
}

TEST_CASE("the compressor runs on the way down, rests on the way up, and cycles at a setpoint") {
  Random random(9);
  Plan plan = one_step(20.0, 40.0);
  plan.setpoints_c = {40.0, 10.0};
  const auto over = hidden::simulate_temperatures(plan, Chain{}, 60.0, random);
  CHECK(over.compressor_on[600] == 0);
  CHECK(over.compressor_on[static_cast<std::size_t>(over.dwells[0].start_s) + 600] == 1);
  const auto from = static_cast<std::ptrdiff_t>(over.dwells[1].start_s) - 1000;
  const auto running =
      std::count(over.compressor_on.begin() + from, over.compressor_on.begin() + from + 840, 1);
  CHECK(running > 250);
  CHECK(running < 590);
}
