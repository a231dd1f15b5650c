#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

/// One window in temperature: drift A f(u), u = (T - T0)/w.
template <double (*shape)(double)>
class Window : public Law {
 public:
  Window(std::string_view name, std::string_view equation)
      : Law({name,
             equation,
             true,
             {{"a", "dps", -5.0, 5.0, 0.03, Spacing::linear, "amplitude as in the equation"},
              {"t0", "degC", -60.0, 130.0, 17.0, Spacing::linear, "where the modes meet"},
              {"w", "degC", 0.1, 20.0, 1.5, Spacing::logarithmic, "half width"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([a = p[0], t0 = p[1], w = p[2]](const Drivers& now) {
      return a * shape((now.die_c - t0) / w);
    });
  }
};

double dispersive(double u) { return u / (1.0 + u * u); }
double absorptive(double u) { return 1.0 / (1.0 + u * u); }
double kink(double u) { return std::sqrt(u * u + 1.0); }
double turn(double u) { return 1.0 - 2.0 / (portable_exp(2.0 * u) + 1.0); }  // tanh

struct Dispersive final : Window<dispersive> {
  Dispersive() : Window("dispersive", "b += A u/(1 + u^2), u = (T - T0)/w") {}
};
struct Absorptive final : Window<absorptive> {
  Absorptive() : Window("absorptive", "b += A/(1 + u^2), u = (T - T0)/w") {}
};
struct Kink final : Window<kink> {
  Kink() : Window("kink", "b += A sqrt(u^2 + 1), u = (T - T0)/w") {}
};
struct Turn final : Window<turn> {
  Turn() : Window("turn", "b += A tanh(u), u = (T - T0)/w") {}
};

class Mixed final : public Law {
 public:
  Mixed()
      : Law({"mixed",
             "b += A (cos(phi) + sin(phi) u)/(1 + u^2), u = (T - T0)/w",
             true,
             {{"a", "dps", -5.0, 5.0, 0.03, Spacing::linear, "amplitude as in the equation"},
              {"t0", "degC", -60.0, 130.0, 17.0, Spacing::linear, "where the modes meet"},
              {"w", "degC", 0.1, 20.0, 1.5, Spacing::logarithmic, "half width"},
              {"phi", "deg", -90.0, 90.0, 45.0, Spacing::linear,
               "demodulation phase: 0 absorptive, 90 dispersive"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    const double turns = p[3] / 360.0;
    return pointwise([a = p[0], t0 = p[1], w = p[2], cosine = portable_sine(turns + 0.25),
                      sine = portable_sine(turns)](const Drivers& now) {
      const double u = (now.die_c - t0) / w;
      return a * (cosine * absorptive(u) + sine * dispersive(u));
    });
  }
};

}  // namespace

Effect mode_crossing() {
  return {"mode_crossing",
          "In a narrow temperature window the drive or sense mode meets a parasitic one. "
          "Quadrature and demodulation phase swing, and the bias with them; every pass, both "
          "directions, at the same die temperature, usually on one axis.",
          Scope::axis,
          slow_drift,
          laws<Dispersive, Absorptive, Kink, Turn, Mixed>(),
          {{"bias_jump", "the same temperature once more"},
           {"condensation_step", "the window in both directions; the other boards"},
           {"missing_codes", "another rate on the table, so that other codes are used"}}};
}

}  // namespace gyrocal::rig
