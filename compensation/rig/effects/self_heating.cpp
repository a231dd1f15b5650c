#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

Parameter warm_up_time() {
  return {"tau", "s", 10.0, 7200.0, 600.0, Spacing::logarithmic, "warm-up after power-on"};
}

class Die final : public Law {
 public:
  Die()
      : Law({"die",
             "T += dT (1 - exp(-t_on/tau))",
             false,
             {{"dt", "degC", -10.0, 10.0, 1.5, Spacing::linear, "final rise of the die"},
              warm_up_time(),
              {"board_share", "1", 0.0, 1.0, 0.3, Spacing::linear,
               "of the rise that the board's sensor sees"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias& bias) const override {
    return pointwise([dt = p[0], tau = p[1], bias](const Drivers& now) {
      const double warm_c = dt * (1.0 - portable_exp(-now.t_on_s / tau));
      return bias.at(now.die_c + warm_c) - bias.at(now.die_c);
    });
  }
  std::unique_ptr<Response> board_reading(Values p) const override {
    return pointwise([dt = p[0] * p[2], tau = p[1]](const Drivers& now) {
      return dt * (1.0 - portable_exp(-now.t_on_s / tau));
    });
  }
};

class Direct final : public Law {
 public:
  Direct()
      : Law({"direct",
             "b += A exp(-t_on/tau)",
             true,
             {{"a", "dps", -2.0, 2.0, 0.02, Spacing::linear, "drift at power-on"},
              warm_up_time()}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise(
        [a = p[0], tau = p[1]](const Drivers& now) { return a * portable_exp(-now.t_on_s / tau); });
  }
};

}  // namespace

Effect self_heating() {
  return {
      "self_heating",
      "Dissipated power warms the die over the board after power-on (law die: through the "
      "bias's slope, and the board's sensor rises too), or the electronics settle directly "
      "(law direct). Only the time since power-on counts.",
      Scope::board,
      slow_drift | board_temperature,
      laws<Die, Direct>(),
      {{"aging_drift", "a power cycle in the middle of a known dwell: only self-heating repeats"},
       {"bias_jump", "a power cycle"},
       {"stress_relaxation", "power on at rest, before the first ramp"},
       {"board_sensor_offset", "board minus chamber at power-on: an offset is there at once"}}};
}

}  // namespace gyrocal::rig
