#include "daemon/campaign/ramp.h"

#include <catch2/catch.hpp>
#include <vector>

namespace gyrocal::campaign {
namespace {

struct Write {
  double t_s;
  double setpoint_c;
};

std::vector<Write> drive(SetpointRamp ramp, double step_s, double until_s) {
  std::vector<Write> writes;
  for (double t = 0; t <= until_s; t += step_s) {
    if (const auto setpoint = ramp.due(seconds(t))) {
      ramp.written(seconds(t), *setpoint);
      writes.push_back({t, setpoint->value});
    }
  }
  CHECK(ramp.finished());
  return writes;
}

}  // namespace

SCENARIO("a ramp of 1 K/min from the air's temperature writes once a minute") {
  const auto writes = drive({seconds(0), Celsius{20.4}, Celsius{24}, Kelvin{1}}, 5, 600);
  REQUIRE(writes.size() == 4);
  CHECK(writes[0].setpoint_c == Approx(21.4));
  CHECK(writes[1].setpoint_c == Approx(22.4));
  CHECK(writes[2].setpoint_c == Approx(23.4));
  CHECK(writes[3].setpoint_c == 24.0);
  for (std::size_t i = 1; i < writes.size(); ++i) CHECK(writes[i].t_s - writes[i - 1].t_s >= 60);
}

SCENARIO("a ramp downwards ends on the target itself and then is silent") {
  const auto writes = drive({seconds(0), Celsius{0.2}, Celsius{-2.05}, Kelvin{1}}, 5, 3600);
  REQUIRE(writes.size() == 3);
  CHECK(writes.back().setpoint_c == -2.05);
}

SCENARIO("a loop slower than a minute still keeps the rate") {
  const auto writes = drive({seconds(0), Celsius{0}, Celsius{10}, Kelvin{1}}, 150, 1800);
  REQUIRE(writes.size() == 5);
  CHECK(writes[1].setpoint_c == Approx(3.5));
}

SCENARIO("a write that was not done is due again") {
  SetpointRamp ramp(seconds(0), Celsius{20}, Celsius{30}, Kelvin{1});
  REQUIRE(ramp.due(seconds(0)));
  CHECK(ramp.due(seconds(5)).has_value());
  ramp.written(seconds(5), *ramp.due(seconds(5)));
  CHECK_FALSE(ramp.due(seconds(10)).has_value());
}

}  // namespace gyrocal::campaign
