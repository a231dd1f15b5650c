#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class ProportionalToRate final : public Law {
 public:
  ProportionalToRate()
      : Law({"proportional",
             "b += k r",
             true,
             {{"k_r", "dps/(degC/min)", -0.5, 0.5, 0.01, Spacing::linear,
               "drift at a die that warms by 1 degC/min"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([k = p[0]](const Drivers& now) { return k * now.die_rate_c_per_min; });
  }
};

}  // namespace

Effect temperature_rate() {
  return {
      "temperature_rate",
      "A die that changes temperature carries a gradient through package and adhesive. The "
      "gradient bends the structure in proportion to the rate, so drift appears on ramps, "
      "changes sign with their direction and vanishes when the temperature stands still.",
      Scope::axis,
      slow_drift,
      laws<ProportionalToRate>(),
      {{"thermal_lag", "ramps where the bias is flat over temperature: a lag shows nothing there"},
       {"compressor_vibration", "line power in the dwells while the chamber cools"},
       {"stress_relaxation", "a long soak: relaxation goes on after the rate is zero"}}};
}

}  // namespace gyrocal::rig
