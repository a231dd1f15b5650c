#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

Parameter slope() {
  return {"s1", "%/degC", -5.0, 5.0, 0.5, Spacing::linear, "growth of sigma; sigma0 is at 20 degC"};
}

class Exponential final : public Law {
 public:
  Exponential() : Law({"exponential", "ln sigma = s0 + s1 (T - 20 degC)", false, {slope()}}) {}
  double noise_factor(Values p, const Drivers& now) const override {
    return portable_exp(0.01 * p[0] * (now.die_c - 20.0));
  }
};

class Proportional final : public Law {
 public:
  Proportional()
      : Law({"proportional", "sigma = sigma0 (1 + s1 (T - 20 degC))", false, {slope()}}) {}
  double noise_factor(Values p, const Drivers& now) const override {
    return std::max(0.0, 1.0 + 0.01 * p[0] * (now.die_c - 20.0));
  }
};

}  // namespace

Effect noise_temperature_dependence() {
  return {"noise_temperature_dependence",
          "Brownian noise goes with the root of temperature, quality factor and amplifier gain "
          "with much more. The spread within a dwell follows the setpoint; its mean does not.",
          Scope::axis,
          distribution,
          laws<Exponential, Proportional>(),
          {{"missing_codes", "sigma over LSB: coarse codes make spread depend on the mean"},
           {"compressor_vibration", "spread against the cooling phases, by frequency band"},
           {"outlier_glitches", "tails or the whole width"}}};
}

}  // namespace gyrocal::rig
