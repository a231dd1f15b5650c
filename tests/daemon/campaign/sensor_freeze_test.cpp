#include "daemon/campaign/sensor_freeze.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace gyrocal::campaign {

SCENARIO("a board that follows the air is not frozen, one that stands while it moves 12 K is") {
  SensorFreeze follows;
  SensorFreeze stands;
  for (double air = 20; air < 31.9; air += 0.1) {
    for (SensorFreeze* sensor : {&follows, &stands}) sensor->air(Celsius{air});
    follows.board(Celsius{std::floor(2 * (air - 8)) / 2});
    stands.board(Celsius{20});
    CHECK_FALSE(follows.frozen());
    CHECK_FALSE(stands.frozen());
  }
  for (SensorFreeze* sensor : {&follows, &stands}) sensor->air(Celsius{32.1});
  CHECK(stands.frozen());
  CHECK_FALSE(follows.frozen());
  stands.board(Celsius{22.5});
  CHECK_FALSE(stands.frozen());
}

SCENARIO("a thermometer that jumps and comes back has not moved the air") {
  SensorFreeze sensor;
  sensor.board(Celsius{20});
  for (const double air : {20.0, 20.1, 35.0, 35.1, 20.2, 20.3}) {
    sensor.air(Celsius{air});
    CHECK_FALSE(sensor.frozen());
  }
}

SCENARIO("a board never heard of is not frozen") {
  SensorFreeze sensor;
  sensor.air(Celsius{0});
  sensor.air(Celsius{50});
  CHECK_FALSE(sensor.frozen());
}

}  // namespace gyrocal::campaign
