#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

Parameter rate(std::string_view meaning) {
  return {"c", "mdps/h", -500.0, 500.0, 1.0, Spacing::linear, meaning};
}
Parameter time_constant() {
  return {"tau", "h", 0.1, 1000.0, 5.0, Spacing::logarithmic, "after which the rate has fallen"};
}

class Linear final : public Law {
 public:
  Linear() : Law({"linear", "b += c t", true, {rate("drift per hour")}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise(
        [c = p[0] * dps_per_mdps](const Drivers& now) { return c * now.t_s / s_per_h; });
  }
};

class Logarithmic final : public Law {
 public:
  Logarithmic()
      : Law({"logarithmic",
             "b += c tau ln(1 + t/tau)",
             true,
             {rate("drift per hour at the start"), time_constant()}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([c = p[0] * dps_per_mdps, tau = p[1]](const Drivers& now) {
      return c * tau * portable_log(1.0 + now.t_s / s_per_h / tau);
    });
  }
};

class Diffusive final : public Law {
 public:
  Diffusive()
      : Law({"diffusive",
             "b += 2 c tau (sqrt(1 + t/tau) - 1)",
             true,
             {rate("drift per hour at the start"), time_constant()}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([c = p[0] * dps_per_mdps, tau = p[1]](const Drivers& now) {
      return 2.0 * c * tau * (std::sqrt(1.0 + now.t_s / s_per_h / tau) - 1.0);
    });
  }
};

}  // namespace

Effect aging_drift() {
  return {"aging_drift",
          "Package, charge or moisture change slowly and one way. The drift grows with campaign "
          "time at all temperatures: evenly, ever more slowly (logarithmic), or with the square "
          "root of time (diffusion).",
          Scope::axis,
          slow_drift,
          laws<Linear, Logarithmic, Diffusive>(),
          {{"self_heating", "the first setpoint again at the end, and a power cycle"},
           {"thermal_hysteresis", "a third pass in the first direction"},
           {"rate_random_walk", "repeated dwells: a walk's differences change sign"},
           {"bias_jump", "three visits of one setpoint: even steps or one"}}};
}

}  // namespace gyrocal::rig
