#include "compensation/rig/chamber_air.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gyrocal;
using namespace gyrocal::rig;

namespace {
ChamberPhysics without_cycling() {
  ChamberPhysics physics;
  physics.cycling_c = 0.0;
  return physics;
}
}  // namespace

TEST_CASE("a chamber that was never started stays at ambient") {
  const ChamberAir air(ChamberPhysics{});
  CHECK(air.at(0.0).value == 23.0);
  CHECK(air.at(1e5).value == 23.0);
  CHECK_FALSE(air.running_at(10.0));
}

TEST_CASE("the air ramps at its limits and approaches the setpoint as one lag") {
  ChamberAir air(without_cycling());
  air.run(100.0, Celsius{53.0});  // 30 degC up at 1 degC/min
  CHECK(air.at(100.0 + 600.0).value == Approx(33.0));
  CHECK(air.rate_c_per_min(700.0) == Approx(1.0));
  // The limit lets go 1 degC below the setpoint, after 29 min; then exp(-t/60 s).
  CHECK(air.at(100.0 + 29 * 60.0).value == Approx(52.0));
  CHECK(air.at(100.0 + 29 * 60.0 + 120.0).value == Approx(53.0 - std::exp(-2.0)));
  air.run(10'000.0, Celsius{-10.0});
  CHECK(air.at(10'000.0 + 600.0).value == Approx(53.0 - 7.0));
  CHECK(air.rate_c_per_min(10'600.0) == Approx(-0.7));
}

TEST_CASE("the air of the past stays what it was when later commands come") {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{40.0});
  const double before = air.at(500.0).value;
  air.run(600.0, Celsius{-10.0});
  air.stop(700.0);
  CHECK(air.at(500.0).value == before);
  CHECK(air.setpoint_at(650.0).value == -10.0);
  CHECK(air.running_at(650.0));
  CHECK_FALSE(air.running_at(701.0));
}

TEST_CASE("the air never jumps when a command comes") {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{40.0});
  air.run(777.0, Celsius{-10.0});
  air.stop(1333.0);
  air.run(1999.0, Celsius{5.0});
  for (const double t : {777.0, 1333.0, 1999.0}) {
    CAPTURE(t);
    CHECK(air.at(t - 1e-6).value == Approx(air.at(t).value).margin(1e-6));
  }
}

TEST_CASE("the controller cycles with its amplitude and period around the setpoint") {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{23.0});
  CHECK(air.at(105.0).value == Approx(23.15));
  CHECK(air.at(315.0).value == Approx(22.85));
  CHECK(air.at(420.0).value == Approx(23.0));
}

TEST_CASE("the rate is the derivative of the temperature") {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{30.0});
  air.stop(4000.0);
  for (double t = 3.0; t < 8000.0; t += 97.0) {
    CAPTURE(t);
    const double numeric = (air.at(t + 0.01).value - air.at(t - 0.01).value) / 0.02 * 60.0;
    CHECK(air.rate_c_per_min(t) == Approx(numeric).margin(1e-6));
  }
}

TEST_CASE("a stopped chamber relaxes to ambient") {
  ChamberAir air(without_cycling());
  air.run(0.0, Celsius{43.0});
  air.stop(10'000.0);
  CHECK(air.at(13'600.0).value == Approx(23.0 + 20.0 * std::exp(-1.0)));
}
