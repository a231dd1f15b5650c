#include <limits>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

class Walk final : public Law {
 public:
  Walk()
      : Law({"walk",
             "S(f) = K^2/(2 pi f)^2, two-sided; variance K^2 t",
             false,
             {{"k", "mdps/sqrt(s)", 0.0, 100.0, 0.05, Spacing::logarithmic,
               "1 sigma after one second"}}}) {}
  std::vector<OuTerm> stochastic(Values p) const override {
    const double k_dps = p[0] * dps_per_mdps;
    return {{std::numeric_limits<double>::infinity(), 0.0, k_dps * k_dps}};
  }
};

}  // namespace

Effect rate_random_walk() {
  return {"rate_random_walk",
          "White noise in what the bias integrates (charge, stress, moisture) makes the bias walk: "
          "its spread grows with the square root of time and has no bond to temperature.",
          Scope::axis,
          slow_drift,
          laws<Walk>(),
          {{"aging_drift", "repeated dwells: a walk's differences change sign"},
           {"bias_instability", "longer watching at one temperature"},
           {"bias_jump", "how fast it happened"}}};
}

}  // namespace gyrocal::rig
