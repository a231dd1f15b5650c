#include "tests/hidden_effects/slow_laws.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/hidden_effects/memory_laws.h"

namespace hidden {
namespace {

constexpr double hour_s = 3600.0;

Series over_time(const Trajectory& over, const std::function<double(double)>& of_second) {
  Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i) series[i] = of_second(static_cast<double>(i));
  return series;
}

SlowLaw temperature_rate(Random& random) {
  SlowLaw law{"temperature_rate",
              "saturating_gradient",
              "dps/(degC/min)",
              "bias per die heating rate, at small rates",
              true,
              0.001,
              0.05,
              {},
              {},
              {}};
  const double softness = random.uniform(0.01, 0.05);
  const double delay_s = random.uniform(3.0, 15.0);
  law.parameters = {{"softness_per_c_per_min", softness}, {"delay_s", delay_s}};
  law.shape = [=](const Trajectory& over) {
    Series gradient(over.seconds());
    double felt = 0.0;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      felt += (over.rate_c_per_min[i] - felt) / delay_s;
      gradient[i] = felt / (1.0 + softness * std::abs(felt));
    }
    return gradient;
  };
  return law;
}

SlowLaw thermal_lag() {
  SlowLaw law{"thermal_lag",
              "two_equal_poles",
              "s",
              "sum of the time constants added between sensor and die",
              true,
              40.0,
              900.0,
              {},
              {},
              {}};
  law.heat = [](Chain& chain, double lag_s) { chain.extra_lag_s = lag_s; };
  return law;
}

SlowLaw self_heating(const std::string& form, Random& random) {
  const double tau_s = random.log_uniform(200.0, 1500.0);
  SlowLaw law{
      "self_heating",     form, "dps", "bias at power-on beyond the settled one", true, 0.002, 0.5,
      {{"tau_s", tau_s}}, {},   {}};
  if (form == "warm_die") {
    law.unit = "degC";
    law.amplitude_means = "what the die ends at above its unpowered temperature";
    law.amplitude_low = 0.3;
    law.amplitude_high = 5.0;
    law.heat = [tau_s](Chain& chain, double rise_c) {
      chain.self_heat_c = rise_c;
      chain.self_heat_s = tau_s;
    };
  } else {
    law.shape = [tau_s](const Trajectory& over) {
      return over_time(over, [tau_s](double t_s) {
        return 0.75 * std::exp(-t_s / tau_s) + 0.25 * std::exp(-t_s / (2.5 * tau_s));
      });
    };
  }
  return law;
}

SlowLaw aging(const std::string& form, const Trajectory& over, Random& random) {
  SlowLaw law{
      "aging_drift", form, "mdps/h", "mean drift over the session", true, 0.01, 5.0, {}, {}, {}};
  const double end_s = static_cast<double>(over.seconds());
  const double end_h = end_s / hour_s;
  if (form == "logarithmic") {
    const double tau_s = end_s * random.uniform(0.4, 2.0);
    law.parameters = {{"tau_s", tau_s}};
    law.shape = [=](const Trajectory& at) {
      return over_time(at, [=](double t_s) {
        return 1e-3 * end_h * std::log1p(t_s / tau_s) / std::log1p(end_s / tau_s);
      });
    };
  } else {
    const double power = random.uniform(0.85, 1.15);
    law.parameters = {{"power", power}};
    law.shape = [=](const Trajectory& at) {
      return over_time(at, [=](double t_s) { return 1e-3 * end_h * std::pow(t_s / end_s, power); });
    };
  }
  return law;
}

SlowLaw bias_jump(const Trajectory& over, Random& random) {
  const double at_s = static_cast<double>(over.seconds()) * random.uniform(0.2, 0.8);
  SlowLaw law{"bias_jump", "step_with_overshoot",
              "dps",       "height of the step once settled",
              true,        0.005,
              0.5,         {{"t_s", at_s}},
              {},          {}};
  law.shape = [at_s](const Trajectory& at) {
    return over_time(at, [at_s](double t_s) {
      const double since_s = t_s - at_s;
      if (since_s < 0.0) return 0.0;
      return (1.0 - std::exp(-since_s / 0.8)) * (1.0 + 0.05 * std::exp(-since_s / 20.0));
    });
  };
  return law;
}

SlowLaw mode_crossing(Random& random) {
  const double center_c = random.uniform(-2.0, 42.0);
  const double width_c = random.log_uniform(0.6, 2.5);
  const double q = random.sign() * random.log_uniform(0.15, 4.0);
  const double skew = random.uniform(-0.2, 0.2);
  SlowLaw law{"mode_crossing",
              "fano",
              "dps",
              "whole swing through the crossing, peak to peak",
              false,
              0.005,
              0.5,
              {{"center_c", center_c}, {"width_c", width_c}, {"fano_q", q}, {"skew", skew}},
              {},
              {}};
  law.shape = [=](const Trajectory& over) {
    Series series(over.seconds());
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double away = (over.die_c[i] - center_c) / width_c;
      const double u = away / (1.0 + skew * std::tanh(away));
      series[i] = ((q + u) * (q + u) / (1.0 + u * u) - 1.0) / (1.0 + q * q);
    }
    return series;
  };
  return law;
}

}  // namespace

std::vector<std::string> laws_of(const std::string& name) {
  static const std::map<std::string, std::vector<std::string>> laws = {
      {"temperature_rate", {"saturating_gradient"}},
      {"thermal_lag", {"two_equal_poles"}},
      {"thermal_hysteresis", {"bouc_wen", "preisach", "play_spectrum"}},
      {"self_heating", {"warm_die", "start_up"}},
      {"aging_drift", {"logarithmic", "power"}},
      {"bias_jump", {"step_with_overshoot"}},
      {"mode_crossing", {"fano"}},
      {"condensation_step", {"logistic_film"}},
      {"stress_relaxation", {"stretched", "two_glues"}},
      {"unknown",
       {"supply_ripple", "growing_leak", "humidity_bursts", "sine_in_temperature", "chirp",
        "sawtooth", "rate_squared", "pulse_train"}}};
  return laws.at(name);
}

SlowLaw draw_law(const std::string& name, const std::string& law, const Trajectory& over,
                 Random& random) {
  if (name == "temperature_rate") return temperature_rate(random);
  if (name == "thermal_lag") return thermal_lag();
  if (name == "thermal_hysteresis") return thermal_hysteresis(law, random);
  if (name == "self_heating") return self_heating(law, random);
  if (name == "aging_drift") return aging(law, over, random);
  if (name == "bias_jump") return bias_jump(over, random);
  if (name == "mode_crossing") return mode_crossing(random);
  if (name == "condensation_step") return condensation_step(random);
  if (name == "stress_relaxation") return stress_relaxation(law, random);
  throw std::invalid_argument("no slow law for " + name);
}

}  // namespace hidden
