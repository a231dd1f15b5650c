#include "compensation/discrepancy/model_update.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "compensation/discrepancy/verdict.h"
#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/empirical_term.h"

namespace gyrocal {
namespace {

constexpr int knots = 48;

bool drifts(const rig::Instance& instance, const rig::CubicBias& bias) {
  return instance.law->drift(instance.values, bias) != nullptr;
}

bool is_drift_noise(std::string_view effect) {
  return effect == "bias_instability" || effect == "rate_random_walk";
}

/// Means of a course between equally spaced values of its driver; nothing where it never was.
rig::EmpiricalTerm as_term(const SlowFinding& finding, const Track& track, std::size_t axis) {
  rig::EmpiricalTerm term;
  term.axes = {axis == 0, axis == 1, axis == 2};
  if (finding.unknown_driver == "die temperature") {
    term.driver = rig::EmpiricalDriver::die;
  } else if (finding.unknown_driver == "heating rate") {
    term.driver = rig::EmpiricalDriver::die_rate;
  } else if (finding.unknown_driver == "chamber minus board") {
    term.driver = rig::EmpiricalDriver::chamber_minus_board;
  } else if (finding.unknown_driver == "time, periodic") {
    term.driver = rig::EmpiricalDriver::phase;
    term.period_s = finding.parameters.front().second;
  } else {
    term.driver = rig::EmpiricalDriver::campaign_time;
  }
  double low = 1e300, high = -1e300;
  for (const rig::Drivers& now : track.record) {
    const double value = rig::driver_value(term, now);
    low = std::min(low, value), high = std::max(high, value);
  }
  std::vector<double> sum(knots, 0.0), count(knots, 0.0);
  for (std::size_t i = 0; i < track.record.size(); ++i) {
    const double at =
        (rig::driver_value(term, track.record[i]) - low) / std::max(high - low, 1e-12);
    const auto k = std::min<std::size_t>(knots - 1, static_cast<std::size_t>(at * knots));
    for (const auto& course : finding.courses) sum[k] += course[i];
    count[k] += 1;
  }
  for (std::size_t k = 0; k < knots; ++k) {
    if (count[k] == 0) continue;
    term.at.push_back(low + (high - low) * (static_cast<double>(k) + 0.5) / knots);
    term.dps.push_back(sum[k] / count[k]);
  }
  return term;
}

}  // namespace

void give_known_effects(std::span<const rig::Instance> instances, const rig::RigModel& model,
                        std::size_t axis, SlowModel& slow) {
  const auto& record = slow.track().record;
  std::vector<double> course(record.size(), 0.0);
  NoiseFamily family;
  for (const rig::Instance& instance : instances) {
    if (!instance.axes[axis]) continue;
    family.flicker = family.flicker || instance.effect->name == "bias_instability";
    family.walk = family.walk || instance.effect->name == "rate_random_walk";
    if (!drifts(instance, slow.bias())) continue;
    const auto added = rig::drift_over(*instance.law, instance.values, slow.bias(), record);
    for (std::size_t i = 0; i < course.size(); ++i) course[i] += added[i];
  }
  for (const rig::EmpiricalTerm& term : model.unexplained) {
    if (!term.axes[axis]) continue;
    for (std::size_t i = 0; i < course.size(); ++i) course[i] += rig::drift_dps(term, record[i]);
  }
  slow.set_known(course);
  slow.set_noise(family);
  slow.refit();
}

void add_findings(SlowModel& slow, const std::vector<SlowFinding>& story, std::size_t count) {
  std::vector<SlowTerm> terms;
  std::vector<std::vector<double>> shapes = slow.shapes();
  NoiseFamily family = slow.noise();
  for (std::size_t i = 0; i < count; ++i) {
    if (story[i].term) terms.push_back(*story[i].term);
    for (const auto& course : story[i].courses) shapes.push_back(course);
    family.flicker = family.flicker || story[i].effect == "bias_instability";
    family.walk = family.walk || story[i].effect == "rate_random_walk";
  }
  slow.set_terms(std::move(terms));
  slow.set_shapes(std::move(shapes));
  slow.set_noise(family);
  slow.refit();
}

bool already_modelled(const Finding& finding, std::span<const rig::Instance> instances) {
  return std::any_of(instances.begin(), instances.end(), [&](const rig::Instance& instance) {
    if (instance.effect->name != finding.effect) return false;
    if (instance.law->info.name == "single") return true;  // its number is a code, not a share
    const double off = std::abs(finding.amplitude - instance.values[0]);
    return off <= std::max(4 * finding.standard_error, 0.25 * std::abs(instance.values[0]));
  });
}

rig::RigModel fast_part(const rig::RigModel& model) {
  rig::RigModel fast = model;
  fast.unexplained.clear();
  std::erase_if(fast.effects, [](const rig::EffectUse& use) {
    const rig::Effect* effect = rig::find_effect(use.effect);
    constexpr unsigned on_samples = rig::spectrum | rig::distribution | rig::link;
    return effect == nullptr || (effect->channels & on_samples) == 0 || is_drift_noise(use.effect);
  });
  return fast;
}

void add_effect(rig::RigModel& model, const Finding& finding, std::size_t axis) {
  const rig::Effect* effect = rig::find_effect(finding.effect);
  if (effect == nullptr) return;
  const rig::Law* law = rig::find_law(*effect, finding.law);
  if (law == nullptr) return;
  rig::EffectUse use;
  use.effect = finding.effect;
  use.law = finding.law;
  use.axes = {axis == 0, axis == 1, axis == 2};
  if (effect->scope != rig::Scope::axis) use.axes = {true, true, true};
  for (const auto& [name, value] : finding.parameters) {
    for (const rig::Parameter& parameter : law->info.parameters) {
      if (parameter.name != name) continue;
      use.parameters.emplace_back(name, std::clamp(value, parameter.low, parameter.high));
    }
  }
  if (use.effect == "missing_codes" && use.law == "single") {
    // One hole a use: the law knows a single code.
    for (const auto& hole : std::exchange(use.parameters, {})) {
      use.parameters = {hole};
      model.effects.push_back(use);
    }
    return;
  }
  // An effect found again, with another amplitude, takes the place of what was known of it.
  std::erase_if(model.effects, [&](const rig::EffectUse& known) {
    return known.effect == use.effect && known.law == use.law && use.effect != "bias_jump";
  });
  model.effects.push_back(std::move(use));
}

rig::RigModel updated_model(const rig::RigModel& given, const SlowModel& slow,
                            const std::vector<SlowFinding>& story, const std::vector<Finding>& fast,
                            const CodeFindings& codes, std::size_t axis, const Track& track) {
  rig::RigModel model = given;
  model.parent = given.name;
  model.baseline.bias[axis] = slow.bias();
  model.baseline.noise_dps = codes.spread_at_20_dps > 0 ? codes.spread_at_20_dps
                             : codes.white_sd_dps > 0   ? codes.white_sd_dps
                                                        : given.baseline.noise_dps;
  if (track.board_sensor.tau_fitted) model.baseline.board_tau_s = track.board_sensor.tau_s;
  for (const Finding& finding : to_findings(story)) add_effect(model, finding, axis);
  for (const Finding& finding : fast) add_effect(model, finding, axis);
  for (const SlowFinding& finding : story) {
    if (finding.effect == "unknown" && !finding.courses.empty()) {
      SlowFinding scaled = finding;
      model.unexplained.push_back(as_term(scaled, track, axis));
    }
  }
  return model;
}

}  // namespace gyrocal
