#include <vector>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/effects/pointwise.h"
#include "compensation/rig/portable_math.h"
#include "compensation/rig/thermal_lags.h"

namespace gyrocal::rig {
namespace {

struct Element {
  double tau_s;
  double share;
};

/// s' = -s/tau + dT/dt is what a lag of tau leaves behind: s = T - L_tau[T]; exact for straight T.
class Creep final : public Response {
 public:
  Creep(double c_dps_per_c, std::vector<Element> elements)
      : c_dps_per_c_(c_dps_per_c), elements_(std::move(elements)) {}

  double at(const Drivers& now) override {
    if (lags_.empty()) {
      for (const Element& e : elements_) lags_.emplace_back(e.tau_s, now.die_c);
      last_s_ = now.t_s;
    }
    double stress_c = 0.0;
    for (std::size_t i = 0; i < lags_.size(); ++i) {
      stress_c += elements_[i].share * (now.die_c - lags_[i].advance(now.t_s - last_s_, now.die_c));
    }
    last_s_ = now.t_s;
    return c_dps_per_c_ * stress_c;
  }

 private:
  double c_dps_per_c_;
  std::vector<Element> elements_;
  std::vector<ThermalLag> lags_;
  double last_s_ = 0.0;
};

Parameter strength() {
  return {
      "c", "mdps/degC", -500.0, 500.0, 2.0, Spacing::linear, "drift right after a step of 1 degC"};
}
Parameter relaxation(std::string_view name, double usual) {
  return {name, "s", 60.0, 86400.0, usual, Spacing::logarithmic, "relaxation time"};
}

class OneTime final : public Law {
 public:
  OneTime()
      : Law({"one_time",
             "s' = -s/tau + dT/dt, b += c s",
             true,
             {strength(), relaxation("tau", 3600.0)}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return std::make_unique<Creep>(p[0] * dps_per_mdps, std::vector<Element>{{p[1], 1.0}});
  }
};

class TwoTimes final : public Law {
 public:
  TwoTimes()
      : Law({"two_times",
             "b += c (q s1 + (1 - q) s2), si' = -si/taui + dT/dt",
             true,
             {strength(),
              relaxation("tau1", 1200.0),
              relaxation("tau2", 9000.0),
              {"q", "1", 0.0, 1.0, 0.5, Spacing::linear, "share of the first"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    return std::make_unique<Creep>(p[0] * dps_per_mdps,
                                   std::vector<Element>{{p[1], p[3]}, {p[2], 1.0 - p[3]}});
  }
};

class Spread final : public Law {
 public:
  Spread()
      : Law({"spread",
             "b += c sum_i q_i s_i, tau_i spread log-normally around tau",
             true,
             {strength(),
              relaxation("tau", 3600.0),
              {"decades", "1", 0.05, 1.0, 0.4, Spacing::linear, "1 sigma of log10 tau"}}}) {}
  std::unique_ptr<Response> drift(Values p, const CubicBias&) const override {
    constexpr double ln_10 = 2.30258509299404568402;
    std::vector<Element> elements;
    double total = 0.0;
    for (const double z : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      const double weight = portable_exp(-0.5 * z * z);
      elements.push_back({p[1] * portable_exp(ln_10 * p[2] * z), weight});
      total += weight;
    }
    for (Element& e : elements) e.share /= total;
    return std::make_unique<Creep>(p[0] * dps_per_mdps, std::move(elements));
  }
};

}  // namespace

Effect stress_relaxation() {
  return {"stress_relaxation",
          "Every change of temperature strains the adhesive, which creeps until the stress is "
          "gone. Each dwell carries an exponential tail whose sign is that of the last step; what "
          "the tail is at a setpoint depends on the hours before.",
          Scope::axis,
          slow_drift,
          laws<OneTime, TwoTimes, Spread>(),
          {{"thermal_hysteresis", "a doubled soak: relaxation decays, hysteresis stays"},
           {"thermal_lag", "a long soak at a setpoint where the bias is flat"},
           {"temperature_rate", "a long soak"},
           {"self_heating", "power on at rest, before the first ramp"}}};
}

}  // namespace gyrocal::rig
