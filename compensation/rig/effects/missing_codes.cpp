#include <algorithm>
#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"

namespace gyrocal::rig {
namespace {

/// What falls into the hole goes to the neighbour on its side.
double around_the_hole(double exact_lsb, double code) {
  return exact_lsb < code ? code - 1.0 : code + 1.0;
}

class Periodic final : public Law {
 public:
  Periodic()
      : Law({"periodic",
             "codes = phase (mod round(1/share)) never come out",
             false,
             {{"share", "1", 0.001, 0.5, 0.125, Spacing::logarithmic, "of all codes"},
              {"phase", "LSB", 0.0, 999.0, 1.0, Spacing::linear, "which of the period"}}}) {}
  double code(Values p, double exact_lsb, double code, double) const override {
    const double period = std::max(2.0, std::floor(1.0 / p[0] + 0.5));
    const double from_hole = code - p[1];
    const double place = from_hole - period * std::floor(from_hole / period);
    return place == 0.0 ? around_the_hole(exact_lsb, code) : code;
  }
};

class Single final : public Law {
 public:
  Single()
      : Law({"single",
             "one code never comes out",
             false,
             {{"code", "LSB", -4095.0, 4095.0, 17.0, Spacing::linear, "which (a whole number)"}}}) {
  }
  double code(Values p, double exact_lsb, double code, double) const override {
    return code == std::floor(p[0] + 0.5) ? around_the_hole(exact_lsb, code) : code;
  }
};

}  // namespace

Effect missing_codes() {
  return {"missing_codes",
          "A converter whose differential non-linearity reaches -1 LSB never puts out some codes; "
          "the neighbours take what belongs to them. Every dwell's histogram has holes at the same "
          "codes, and means shift as the bias moves across them.",
          Scope::axis,
          distribution,
          laws<Periodic, Single>(),
          {{"mode_crossing", "another rate on the table, so that other codes are used"},
           {"saturation", "whether codes beyond the hole occur"},
           {"noise_temperature_dependence", "sigma over LSB"}}};
}

}  // namespace gyrocal::rig
