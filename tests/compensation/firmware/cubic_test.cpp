#include "compensation/firmware/cubic.h"

#include <catch2/catch.hpp>

#include "compensation/firmware/ardupilot.h"

using namespace gyrocal;

namespace {

/// 4 - 0.01 T + 2e-4 T^2 - 1e-6 T^3 as a curve over -10 ... 50 degC.
DriftCurve cubic_curve() {
  TemperaturePolynomial p{{20, 10, Eigen::VectorXd(4)}};
  const auto value = [](double t) { return 4 - 0.01 * t + 2e-4 * t * t - 1e-6 * t * t * t; };
  Eigen::VectorXd t(4), y(4);
  t << -10, 10, 30, 50;
  y = t.unaryExpr(value);
  p.polynomial = fit_polynomial(t, y, 3).value();
  return {{{-10, 10, 30, 50}}, p};
}

}  // namespace

TEST_CASE("a cubic is its own nearest cubic around any reference", "[firmware]") {
  for (const double reference : {-300.0, 0.0, 25.0, 35.0}) {
    const auto cubic = nearest_cubic(cubic_curve(), reference);
    REQUIRE(cubic.has_value());
    for (double t = -10; t <= 50; t += 7.5) {
      CHECK(value_at(*cubic, t) == Approx(cubic_curve().at({t})).epsilon(1e-9));
    }
  }
  const auto at_zero = nearest_cubic(cubic_curve(), 0);
  CHECK(at_zero->dps[0] == Approx(4));
  CHECK(at_zero->dps[1] == Approx(-0.01));
  CHECK(at_zero->dps[2] == Approx(2e-4));
  CHECK(at_zero->dps[3] == Approx(-1e-6));
}

TEST_CASE("PX4 clips the temperature to its range and works in rad/s", "[firmware]") {
  const AxisCubic axis{{"A", "y", "board"}, nearest_cubic(cubic_curve(), px4_reference_c).value()};
  const auto text = px4_text({&axis, 1}, 2, 3408138, "comment");
  CHECK(text.find("1\t1\tTC_G2_ID\t3408138\t6\n") != std::string::npos);
  CHECK(text.find("_2\t") == std::string::npos);  // nothing about z
  const auto gyro = read_px4_text(text, 2, "y");
  REQUIRE(gyro.has_value());
  CHECK(gyro->tref == 25);
  const double at_ref = cubic_curve().at({25}) * 3.14159265358979 / 180;
  CHECK(gyro->x[0] == Approx(at_ref).epsilon(1e-6));
  CHECK(offset_rad_s(*gyro, 25) == Approx(at_ref).epsilon(1e-6));
  CHECK(offset_rad_s(*gyro, -40) == offset_rad_s(*gyro, -10));
  CHECK(offset_rad_s(*gyro, 80) == offset_rad_s(*gyro, 50));
  CHECK_FALSE(read_px4_text(text, 2, "z").has_value());
  CHECK_FALSE(read_px4_text(text, 0, "y").has_value());
}

TEST_CASE("a device id with the highest bit set stays the same 32 bits", "[firmware]") {
  const AxisCubic axis{{"A", "z", "board"}, nearest_cubic(cubic_curve(), px4_reference_c).value()};
  CHECK(px4_text({&axis, 1}, 0, 0xFFFFFFFEU, "").find("TC_G0_ID\t-2\t6") != std::string::npos);
}

TEST_CASE("ArduPilot scales by a million, counts from 35 degC and keeps the constant apart",
          "[firmware]") {
  const AxisCubic axis{{"A", "z", "board"},
                       nearest_cubic(cubic_curve(), ardupilot_reference_c).value()};
  const auto text = ardupilot_text({&axis, 1}, 1, "comment");
  const auto gyro = read_ardupilot_text(text, 1, "z");
  REQUIRE(gyro.has_value());
  const double rad = 3.14159265358979 / 180;
  // d/dT at 35 degC: -0.01 + 4e-4 * 35 - 3e-6 * 35^2
  CHECK(gyro->g[0] == Approx((-0.01 + 0.014 - 0.003675) * rad * 1e6).epsilon(1e-5));
  CHECK(gyro->g[2] == Approx(-1e-6 * rad * 1e6).epsilon(1e-5));
  CHECK(gyro->caltemp == 35);
  CHECK(gyro->offset == Approx(cubic_curve().at({35}) * rad).epsilon(1e-6));
  for (const float t : {-10.0F, 0.0F, 35.0F, 50.0F}) {
    CHECK(offset_rad_s(*gyro, t) == Approx(cubic_curve().at({t}) * rad).epsilon(1e-5));
  }
  CHECK(offset_rad_s(*gyro, 70) == offset_rad_s(*gyro, 50));
  CHECK(ardupilot_text({&axis, 1}, 2, "").find("INS_GYR2OFFS_Z,") != std::string::npos);
  CHECK(text.find("INS_GYROFFS_Z,") != std::string::npos);
}
