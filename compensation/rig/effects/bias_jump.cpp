#include <algorithm>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Step final : public Law {
 public:
  Step()
      : Law({"step",
             "b += A (t >= t0)",
             true,
             {{"a", "dps", -5.0, 5.0, 0.02, Spacing::linear, "height"},
              {"t0", "s", 0.0, 1e7, 18000.0, Spacing::linear, "instant, campaign time"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([a = p[0], t0 = p[1]](const Drivers& now) { return now.t_s >= t0 ? a : 0.0; });
  }
};

class Slide final : public Law {
 public:
  Slide()
      : Law({"slide",
             "b += A min(1, max(0, (t - t0)/d))",
             true,
             {{"a", "dps", -5.0, 5.0, 0.02, Spacing::linear, "height"},
              {"t0", "s", 0.0, 1e7, 18000.0, Spacing::linear, "beginning, campaign time"},
              {"d", "s", 0.1, 600.0, 20.0, Spacing::logarithmic, "how long it takes"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([a = p[0], t0 = p[1], d = p[2]](const Drivers& now) {
      return a * std::clamp((now.t_s - t0) / d, 0.0, 1.0);
    });
  }
};

}  // namespace

Effect bias_jump() {
  return {"bias_jump",
          "A particle moves, a contact or a charge changes, the board is knocked. The bias is "
          "another from one second to the next, at any temperature, and stays so: revisiting the "
          "temperature does not undo it.",
          Scope::axis,
          slow_drift,
          laws<Step, Slide>(),
          {{"condensation_step", "the other boards in the chamber; a second heating pass"},
           {"mode_crossing", "the temperature of the jump once more"},
           {"random_telegraph_noise", "longer watching: telegraph noise comes back"},
           {"rate_random_walk", "how fast it happened"}}};
}

}  // namespace gyrocal::rig
