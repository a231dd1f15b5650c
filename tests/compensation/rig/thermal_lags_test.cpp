#include "compensation/rig/thermal_lags.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gyrocal::rig;

TEST_CASE("a step of the air reaches board and die as two first-order lags in a row") {
  BoardThermals thermals(240.0, 40.0, 20.0);
  thermals.advance(0.0, 50.0);  // the air jumps
  for (int i = 0; i < 1000; ++i) {
    thermals.advance(1.0, 50.0);
    const double t = i + 1.0;
    const double board = 50.0 - 30.0 * std::exp(-t / 240.0);
    const double die =
        50.0 - 30.0 * (240.0 * std::exp(-t / 240.0) - 40.0 * std::exp(-t / 40.0)) / 200.0;
    CAPTURE(t);
    CHECK(thermals.board_c() == Approx(board).epsilon(1e-12));
    CHECK(thermals.die_c() == Approx(die).epsilon(1e-12));
  }
}

TEST_CASE("on a long ramp the board trails by its tau and the die by both") {
  BoardThermals thermals(240.0, 40.0, 0.0);
  double air = 0.0;
  for (int i = 0; i < 5000; ++i) thermals.advance(1.0, air += 1.0 / 60.0);
  CHECK(air - thermals.board_c() == Approx(4.0).epsilon(1e-8));
  CHECK(thermals.board_c() - thermals.die_c() == Approx(40.0 / 60.0).epsilon(1e-8));
  CHECK(thermals.die_rate_c_per_min() == Approx(1.0).epsilon(1e-8));
}

TEST_CASE("a straight input gives the same whatever the steps, equal time constants included") {
  for (const double tau_die : {40.0, 240.0}) {
    BoardThermals fine(240.0, tau_die, 10.0);
    BoardThermals coarse(240.0, tau_die, 10.0);
    ThermalLag lag_fine(900.0, 10.0);
    ThermalLag lag_coarse(900.0, 10.0);
    for (int i = 1; i <= 6000; ++i) {
      fine.advance(0.1, 10.0 + 0.005 * i);
      lag_fine.advance(0.1, 10.0 + 0.005 * i);
    }
    double t_s = 0.0;
    for (const double dt_s : {100.0, 7.0, 493.0}) {
      t_s += dt_s;
      coarse.advance(dt_s, 10.0 + 0.05 * t_s);
      lag_coarse.advance(dt_s, 10.0 + 0.05 * t_s);
    }
    CHECK(fine.board_c() == Approx(coarse.board_c()).epsilon(1e-12));
    CHECK(fine.die_c() == Approx(coarse.die_c()).epsilon(1e-12));
    CHECK(lag_fine.value() == Approx(lag_coarse.value()).epsilon(1e-11));
  }
}

TEST_CASE("a single lag follows the analytic step response") {
  ThermalLag lag(60.0, 0.0);
  lag.advance(0.0, 1.0);
  CHECK(lag.advance(60.0, 1.0) == Approx(1.0 - std::exp(-1.0)).epsilon(1e-14));
}
