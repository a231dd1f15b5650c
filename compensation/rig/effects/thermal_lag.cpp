#include <vector>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/thermal_lags.h"

namespace gyrocal::rig {
namespace {

/// b(lagged T) - b(T): `poles` equal lags in a row share the whole delay.
class LaggedBias final : public Response {
 public:
  LaggedBias(double tau_s, int poles, const CubicBias& bias)
      : tau_s_(tau_s), poles_(poles), bias_(bias) {}

  double at(const Drivers& now) override {
    if (lags_.empty()) {
      lags_.assign(static_cast<std::size_t>(poles_), ThermalLag(tau_s_ / poles_, now.die_c));
      last_s_ = now.t_s;
    }
    double through_c = now.die_c;
    for (ThermalLag& lag : lags_) through_c = lag.advance(now.t_s - last_s_, through_c);
    last_s_ = now.t_s;
    return bias_.at(through_c) - bias_.at(now.die_c);
  }

 private:
  double tau_s_;
  int poles_;
  CubicBias bias_;
  std::vector<ThermalLag> lags_;
  double last_s_ = 0.0;
};

Parameter delay(double low, double high, double usual, std::string_view meaning) {
  return {"tau", "s", low, high, usual, Spacing::logarithmic, meaning};
}

class Pole final : public Law {
 public:
  Pole()
      : Law({"pole",
             "b(T) -> b(L_tau[T])",
             false,
             {delay(1.0, 3600.0, 60.0, "one more first-order lag behind the die")}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias& bias) const override {
    return std::make_unique<LaggedBias>(p[0], 1, bias);
  }
};

class Cascade final : public Law {
 public:
  Cascade()
      : Law({"cascade",
             "b(T) -> b(L_tau/4[L_tau/4[L_tau/4[L_tau/4[T]]]])",
             false,
             {delay(1.0, 3600.0, 60.0, "whole delay of four equal lags: heat that diffuses")}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias& bias) const override {
    return std::make_unique<LaggedBias>(p[0], 4, bias);
  }
};

class Lead final : public Law {
 public:
  Lead()
      : Law({"lead",
             "b(T) -> b(T + tau r)",
             false,
             {delay(1.0, 240.0, 20.0, "by how much the assumed lags are too long")}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias& bias) const override {
    return pointwise([tau_min = p[0] / 60.0, bias](const Drivers& now) {
      return bias.at(now.die_c + tau_min * now.die_rate_c_per_min) - bias.at(now.die_c);
    });
  }
};

}  // namespace

Effect thermal_lag() {
  return {
      "thermal_lag",
      "What sets the bias is not where the temperature is known: another mass in between, or a "
      "wrong time constant, lets it trail (or lead). To first order the drift is -tau b'(T) r: "
      "it needs a slope of the bias and vanishes where the bias is flat.",
      Scope::axis,
      slow_drift,
      laws<Pole, Cascade, Lead>(),
      {{"temperature_rate", "ramps where the bias is flat: a rate effect stays, a lag vanishes"},
       {"stress_relaxation", "a long soak, and ramps over the flat part of the bias"},
       {"board_sensor_offset", "the chamber's record against the board's sensor on ramps"}}};
}

}  // namespace gyrocal::rig
