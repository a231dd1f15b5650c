#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {
namespace {

Parameter sensitivity(std::string_view name) {
  return {name, "dps/g", -1.0, 1.0, 0.05, Spacing::linear, "drift per g along this axis"};
}
Parameter tilt() {
  return {"tilt", "deg", -45.0, 45.0, 5.0, Spacing::linear, "final tilt about the y axis"};
}

std::array<double, 3> tilted(double degrees) {
  const double turns = degrees / 360.0;
  return {portable_sine(turns), 0.0, portable_sine(turns + 0.25) - 1.0};
}

std::unique_ptr<Response> along_x(double g_dps) {
  return pointwise([g_dps](const Drivers& now) { return g_dps * now.acc_g[0]; });
}

class TiltCreep final : public Law {
 public:
  TiltCreep()
      : Law({"tilt_creep",
             "b += G a_x, tilt(t) = tilt (1 - exp(-t/tau))",
             true,
             {sensitivity("g"),
              tilt(),
              {"tau", "h", 0.1, 1000.0, 5.0, Spacing::logarithmic, "creep of the mounting"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return along_x(p[0]);
  }
  std::array<double, 3> tilt_g(Values p, const Drivers& now) const override {
    return tilted(p[1] * (1.0 - portable_exp(-now.t_s / s_per_h / p[2])));
  }
};

class Reseating final : public Law {
 public:
  Reseating()
      : Law({"reseating",
             "b += G a_x, tilt(t) = tilt (t >= t0)",
             true,
             {sensitivity("g"),
              tilt(),
              {"t0", "s", 0.0, 1e7, 18000.0, Spacing::linear, "when the board moved"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return along_x(p[0]);
  }
  std::array<double, 3> tilt_g(Values p, const Drivers& now) const override {
    return tilted(now.t_s >= p[2] ? p[1] : 0.0);
  }
};

class Measured final : public Law {
 public:
  Measured()
      : Law({"measured",
             "b += G . a, a from the accelerometer",
             true,
             {// Along an axis that the board hardly moved the share may come out large.
              {"g", "dps/g", -50.0, 50.0, 0.05, Spacing::linear, "drift per g along x"},
              {"y_share", "1", -100.0, 100.0, 0.0, Spacing::linear, "G_y / G_x"},
              {"z_share", "1", -100.0, 100.0, 0.0, Spacing::linear, "G_z / G_x"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return pointwise([g = p[0], y = p[1], z = p[2]](const Drivers& now) {
      return g * (now.acc_g[0] + y * now.acc_g[1] + z * now.acc_g[2]);
    });
  }
};

}  // namespace

Effect g_sensitivity() {
  return {"g_sensitivity",
          "A proof mass that is not balanced turns specific force into rate: b += G . a. On a "
          "board at rest that is a constant and cannot be seen; it shows when the mounting creeps "
          "or is moved, in step with the accelerometer, and flips sign with the board.",
          Scope::axis,
          slow_drift | acceleration,
          laws<TiltCreep, Reseating, Measured>(),
          {{"bias_jump", "the accelerometer at the same instant; the board turned by 180 degrees"},
           {"aging_drift", "the accelerometer over the campaign"}}};
}

}  // namespace gyrocal::rig
