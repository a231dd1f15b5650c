#include "compensation/rig/effects/effect.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/portable_math.h"
#include "compensation/values/assert.h"
#include "compensation/values/nearest_name.h"

namespace gyrocal::rig {
namespace {

/// Advice for a name that none of `items` has.
template <class Items, class Name>
std::string known(const std::string& asked, const Items& items, Name name) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(name(item));
  return fmt::format("{}known: {}", is_meant(asked, names), fmt::join(names, ", "));
}

Result<std::size_t> parameter_index(const Effect& effect, const Law& law, const std::string& name) {
  const auto& parameters = law.info.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == name) return i;
  }
  return fail(
      Errc::unknown_name,
      fmt::format("effect {}, law {}: unknown parameter \"{}\"", effect.name, law.info.name, name),
      known(name, parameters, [](const Parameter& p) { return p.name; }));
}

}  // namespace

double spectral_density(const OuTerm& term, double f_hz) {
  const double omega = two_pi * f_hz;
  if (std::isinf(term.tau_s)) return term.walk_dps2_per_s / (omega * omega);
  const double x = omega * term.tau_s;
  return 2.0 * term.variance_dps2 * term.tau_s / (1.0 + x * x);
}

double spectral_density(const Telegraph& telegraph, double f_hz) {
  const double low = telegraph.low_dwell_s;
  const double high = telegraph.high_dwell_s;
  const double share = low / (low + high);
  const double variance = telegraph.level_dps * telegraph.level_dps * share * (1.0 - share);
  return spectral_density(OuTerm{low * high / (low + high), variance}, f_hz);
}

double alias_hz(double f_hz, double sample_rate_hz) {
  return std::abs(f_hz - sample_rate_hz * std::floor(f_hz / sample_rate_hz + 0.5));
}

std::unique_ptr<Response> Law::drift(Values, const CubicBias&) const { return nullptr; }
std::unique_ptr<Response> Law::board_reading(Values) const { return nullptr; }
std::vector<OuTerm> Law::stochastic(Values) const { return {}; }
Telegraph Law::telegraph(Values, const Drivers&) const { return {0.0, 1.0, 1.0}; }
std::vector<Line> Law::lines(Values, const Drivers&) const { return {}; }
double Law::noise_factor(Values, const Drivers&) const { return 1.0; }
std::array<double, 3> Law::tilt_g(Values, const Drivers&) const { return {0.0, 0.0, 0.0}; }
double Law::code(Values, double, double code, double) const { return code; }
Loss Law::loss(Values) const { return {0.0, 1.0}; }
std::unique_ptr<SampleChange> Law::samples(Values, const StreamKey&) const { return nullptr; }

std::vector<double> usual_values(const Law& law) {
  std::vector<double> values;
  for (const Parameter& parameter : law.info.parameters) values.push_back(parameter.usual);
  return values;
}

std::vector<double> drift_over(const Law& law, Values values, const CubicBias& bias,
                               std::span<const Drivers> record) {
  GYROCAL_ASSERT(values.size() == law.info.parameters.size());
  std::vector<double> dps(record.size(), 0.0);
  const auto response = law.drift(values, bias);
  if (!response) return dps;
  for (std::size_t i = 0; i < record.size(); ++i) dps[i] = response->at(record[i]);
  return dps;
}

Result<Instance> instantiate(const EffectUse& use) {
  const Effect* effect = find_effect(use.effect);
  if (effect == nullptr) {
    return fail(Errc::unknown_name, fmt::format("unknown effect \"{}\"", use.effect),
                known(use.effect, catalogue(), [](const Effect& e) { return e.name; }));
  }
  const Law* law = use.law.empty() ? effect->laws.front().get() : find_law(*effect, use.law);
  if (law == nullptr) {
    return fail(Errc::unknown_name,
                fmt::format("effect {}: unknown law \"{}\"", effect->name, use.law),
                known(use.law, effect->laws, [](const auto& l) { return l->info.name; }));
  }
  Instance instance{effect, law, usual_values(*law), use.axes, use.boards};
  for (const auto& [name, value] : use.parameters) {
    const auto index = parameter_index(*effect, *law, name);
    if (!index) return tl::unexpected(index.error());
    const Parameter& known = law->info.parameters[*index];
    const auto where = fmt::format("effect {}, law {}, parameter {}: {} {}", effect->name,
                                   law->info.name, name, value, known.unit);
    const auto range = fmt::format("allowed: {}..{} {}", known.low, known.high, known.unit);
    if (!std::isfinite(value)) return fail(Errc::not_finite, where + " is no number", range);
    if (value < known.low || value > known.high) {
      return fail(Errc::out_of_range, where + " is out of range", range);
    }
    instance.values[*index] = value;
  }
  return instance;
}

EffectUse completed(const EffectUse& use) {
  const auto instance = instantiate(use);
  GYROCAL_ASSERT(instance.has_value());
  EffectUse whole = use;
  whole.law = std::string(instance->law->info.name);
  whole.parameters.clear();
  for (std::size_t i = 0; i < instance->values.size(); ++i) {
    whole.parameters.emplace_back(instance->law->info.parameters[i].name, instance->values[i]);
  }
  return whole;
}

Result<std::vector<Instance>> instantiate(const RigModel& model) {
  std::vector<Instance> instances;
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    auto instance = instantiate(model.effects[i]);
    if (!instance) return tl::unexpected(instance.error());
    instances.push_back(std::move(*instance));
  }
  return instances;
}

}  // namespace gyrocal::rig
