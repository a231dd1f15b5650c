#include "daemon/campaign/supervisor.h"

#include <catch2/catch.hpp>

namespace gyrocal::campaign {
namespace {

const SetpointRange allowed{Celsius{-20}, Celsius{70}};

ChamberReading reading(double air, double setpoint) {
  return {Celsius{air}, Celsius{setpoint}, ChamberRun::running, true};
}

}  // namespace

SCENARIO("air beyond the limits trips at once") {
  Supervisor supervisor(allowed);
  CHECK_FALSE(supervisor.look(seconds(0), reading(74.9, 70), Celsius{70}));
  const auto trip = supervisor.look(seconds(5), reading(75.1, 70), Celsius{70});
  REQUIRE(trip);
  CHECK_FALSE(trip->hands_off);
  CHECK(supervisor.look(seconds(10), reading(-25.1, -20), Celsius{-20}));
}

SCENARIO("another setpoint than ours, seen twice, is somebody else's hand") {
  Supervisor supervisor(allowed);
  CHECK_FALSE(supervisor.look(seconds(0), reading(20, 55), Celsius{20}));
  CHECK_FALSE(supervisor.look(seconds(5), reading(20, 20), Celsius{20}));
  CHECK_FALSE(supervisor.look(seconds(10), reading(20, 55), Celsius{20}));
  const auto trip = supervisor.look(seconds(15), reading(20, 55), Celsius{20});
  REQUIRE(trip);
  CHECK(trip->hands_off);
}

SCENARIO("a chamber stopped at its panel, or one running a program, is not ours") {
  for (const bool stopped : {true, false}) {
    Supervisor supervisor(allowed);
    ChamberReading seen = reading(20, 20);
    if (stopped) seen.run = ChamberRun::stopped;
    if (!stopped) seen.constant_mode = false;
    CHECK_FALSE(supervisor.look(seconds(0), seen, Celsius{20}));
    REQUIRE(supervisor.look(seconds(5), seen, Celsius{20}));
  }
}

SCENARIO("before anything was written, nothing that stands there is foreign") {
  Supervisor supervisor(allowed);
  for (int i = 0; i < 10; ++i) {
    CHECK_FALSE(supervisor.look(seconds(5 * i), reading(20, 55), std::nullopt));
  }
}

SCENARIO("a door open for nine minutes is lived with, one open for eleven trips") {
  for (const int minutes : {9, 11}) {
    Supervisor supervisor(allowed);
    static_cast<void>(supervisor.look(seconds(0), reading(50, 50), Celsius{50}));
    supervisor.sent_to(Celsius{50});
    std::optional<Trip> trip;
    for (int t = 5; t <= 60 * minutes; t += 5) {
      trip = supervisor.look(seconds(t), reading(30 + 0.001 * (t % 7), 50), Celsius{50});
      if (trip) break;
    }
    CHECK(trip.has_value() == (minutes == 11));
  }
}

SCENARIO("cooling where it should heat trips") {
  Supervisor supervisor(allowed);
  static_cast<void>(supervisor.look(seconds(0), reading(20, 20), Celsius{20}));
  supervisor.sent_to(Celsius{50});
  std::optional<Trip> trip;
  for (int t = 5; t <= 3600 && !trip; t += 5) {
    trip = supervisor.look(seconds(t), reading(20 - t / 60.0, 50), Celsius{50});
  }
  REQUIRE(trip);
  CHECK(trip->why.find("off its way") != std::string::npos);
}

SCENARIO("a reading that stands still far from the setpoint is stuck") {
  Supervisor supervisor(allowed);
  std::optional<Trip> trip;
  int t = 0;
  for (; t <= 1200 && !trip; t += 5)
    trip = supervisor.look(seconds(t), reading(20, 50), Celsius{50});
  REQUIRE(trip);
  CHECK(t > 600);
  Supervisor soaking(allowed);
  for (t = 0; t <= 7200; t += 5) {
    CHECK_FALSE(soaking.look(seconds(t), reading(50, 50), Celsius{50}));
  }
}

TEST_CASE("a chamber half as fast, or three times, raises no alarm", "[supervisor]") {
  for (const double k_per_min : {0.5, 1.0, 3.0}) {
    Supervisor supervisor(allowed);
    double air = 25;
    double t = 0;
    for (const double target : {-10.0, 50.0, 25.0}) {
      static_cast<void>(supervisor.look(seconds(t), reading(air, air), std::nullopt));
      supervisor.sent_to(Celsius{target});
      for (int i = 0; i < 3600; ++i, t += 5) {
        const double step = k_per_min * 5 / 60;
        air += std::clamp(target - air, -step, step) + (i % 2 ? 1e-4 : -1e-4);
        REQUIRE_FALSE(supervisor.look(seconds(t), reading(air, target), Celsius{target}));
      }
    }
  }
}

}  // namespace gyrocal::campaign
