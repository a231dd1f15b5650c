#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Flicker final : public Law {
 public:
  Flicker()
      : Law({"flicker",
             "S(f) = B^2/(2 pi f), two-sided",
             false,
             {{"b", "deg/h", 0.0, 1000.0, 7.0, Spacing::logarithmic,
               "the Allan deviation's floor is 0.664 B"}}}) {}

  /// Half-decades of Ornstein-Uhlenbeck processes from 1 s to 11 days: within 5 % of 1/f between
  /// 1e-5 and 0.02 Hz. Faster parts drown in white noise and are left out.
  std::vector<OuTerm> stochastic(Values p) const override {
    constexpr double pi = 3.14159265358979323846;
    constexpr double root_10 = 3.16227766016837933;
    constexpr double ln_root_10 = 1.15129254649702284;
    const double b_dps = p[0] / s_per_h;
    std::vector<OuTerm> terms;
    double tau_s = 1.0;
    for (int i = 0; i < 13; ++i, tau_s *= root_10) {
      terms.push_back({tau_s, b_dps * b_dps * ln_root_10 / pi});
    }
    return terms;
  }
};

}  // namespace

Effect bias_instability() {
  return {
      "bias_instability",
      "Many traps and slow mechanical states together give 1/f noise: the bias never settles, "
      "each octave of frequency holds the same power. Averaging longer does not help beyond "
      "the floor of the Allan deviation.",
      Scope::axis,
      slow_drift,
      laws<Flicker>(),
      {{"rate_random_walk", "longer watching at one temperature: a walk grows, flicker does not"},
       {"mains_hum", "some dwells at another sample rate"},
       {"random_telegraph_noise", "two levels in the histogram"}}};
}

}  // namespace gyrocal::rig
