#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Offset final : public Law {
 public:
  Offset()
      : Law({"offset",
             "T_b += d",
             true,
             {{"d", "degC", -10.0, 10.0, 1.0, Spacing::linear,
               "what the sensor reads too high"}}}) {}
  std::unique_ptr<Response> board_reading(Values p) const override {
    return pointwise([d = p[0]](const Drivers&) { return d; });
  }
};

class Gain final : public Law {
 public:
  Gain()
      : Law({"gain",
             "T_b += e (T_b - 25 degC)",
             true,
             {{"e", "degC/degC", -0.2, 0.2, 0.02, Spacing::linear, "error of the slope"}}}) {}
  std::unique_ptr<Response> board_reading(Values p) const override {
    return pointwise([e = p[0]](const Drivers& now) { return e * (now.board_c - 25.0); });
  }
};

}  // namespace

Effect board_sensor_offset() {
  return {"board_sensor_offset",
          "The board's temperature sensor reads wrong: by a constant, or in proportion. The gyro "
          "feels nothing; board minus chamber is off in every dwell, from the first second on, and "
          "a model fitted over that sensor is shifted along its axis.",
          Scope::board,
          board_temperature,
          laws<Offset, Gain>(),
          {{"self_heating", "power on at rest: self-heating has a transient, an offset is there"}}};
}

}  // namespace gyrocal::rig
