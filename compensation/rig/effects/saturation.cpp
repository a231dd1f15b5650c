#include <algorithm>
#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

double rail_code(double dps, double lsb_dps) { return std::floor(dps / lsb_dps + 0.5); }

class Upper final : public Law {
 public:
  Upper()
      : Law({"upper",
             "y = min(y, hi)",
             false,
             {{"hi", "dps", -2000.0, 2000.0, 6.0, Spacing::linear, "upper rail"}}}) {}
  double code(Values p, double, double code, double lsb_dps) const override {
    return std::min(code, rail_code(p[0], lsb_dps));
  }
};

class Lower final : public Law {
 public:
  Lower()
      : Law({"lower",
             "y = max(y, lo)",
             false,
             {{"lo", "dps", -2000.0, 2000.0, 2.0, Spacing::linear, "lower rail"}}}) {}
  double code(Values p, double, double code, double lsb_dps) const override {
    return std::max(code, rail_code(p[0], lsb_dps));
  }
};

}  // namespace

Effect saturation() {
  return {"saturation",
          "Amplifier or range ends before the signal does: everything beyond the rail comes out as "
          "the last code. Mass piles up there, the distribution is skewed and the mean pulled in, "
          "most where the bias lies nearest to the rail.",
          Scope::axis,
          distribution,
          laws<Upper, Lower>(),
          {{"missing_codes", "whether any code beyond occurs"},
           {"stuck_samples", "whether the end code comes in runs at any bias"},
           {"noise_temperature_dependence", "skew of the dwells"}}};
}

}  // namespace gyrocal::rig
