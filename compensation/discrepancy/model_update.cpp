#include "compensation/discrepancy/model_update.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "compensation/discrepancy/slow_smoother.h"
#include "compensation/discrepancy/verdict.h"
#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/empirical_term.h"

namespace gyrocal {
namespace {

constexpr int knots_usual = 48;
constexpr double time_knot_s = 120;
constexpr int knots_max = 720;
constexpr double same_line_hz = 0.05;

bool drifts(const rig::Instance& instance, const rig::CubicBias& bias) {
  return instance.law->drift(instance.values, bias) != nullptr;
}

bool is_drift_noise(std::string_view effect) {
  return effect == "bias_instability" || effect == "rate_random_walk";
}

rig::EmpiricalTerm term_for(std::size_t axis) {
  rig::EmpiricalTerm term;
  term.axes = {axis == 0, axis == 1, axis == 2};
  return term;
}

/// A driver that the rig model does not know is told by its course over time.
void set_driver(const SlowFinding& finding, rig::EmpiricalTerm& term) {
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
}

/// Means of a course between equally spaced values of its driver; nothing where it never was.
/// @param course  at the track's instants [deg/s].
rig::EmpiricalTerm as_term(const SlowFinding& finding, const std::vector<double>& course,
                           const Track& track, std::size_t axis) {
  rig::EmpiricalTerm term = term_for(axis);
  set_driver(finding, term);
  double low = 1e300, high = -1e300;
  for (const rig::Drivers& now : track.record) {
    const double value = rig::driver_value(term, now);
    low = std::min(low, value), high = std::max(high, value);
  }
  const int knots =
      term.driver == rig::EmpiricalDriver::campaign_time
          ? std::clamp(static_cast<int>((high - low) / time_knot_s), knots_usual, knots_max)
          : knots_usual;
  std::vector<double> sum(static_cast<std::size_t>(knots), 0.0), count(sum.size(), 0.0);
  for (std::size_t i = 0; i < track.record.size(); ++i) {
    const double at =
        (rig::driver_value(term, track.record[i]) - low) / std::max(high - low, 1e-12);
    const auto k = std::min(sum.size() - 1, static_cast<std::size_t>(at * knots));
    sum[k] += course[i];
    count[k] += 1;
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] == 0) continue;
    term.at.push_back(low + (high - low) * (static_cast<double>(k) + 0.5) / knots);
    term.dps.push_back(sum[k] / count[k]);
  }
  return term;
}

/// What drift without a law was doing, by the rows that were fitted: what the noise of the model
/// and its levels made of them, between kept-out parts on straight lines.
rig::EmpiricalTerm followed_drift(const SlowModel& slow, std::size_t axis) {
  const SlowFit& fit = slow.fit();
  const SlowGrid& grid = slow.stream().grid();
  const Eigen::VectorXd residual = slow.y() - slow.design() * fit.coefficients;
  const DriftEstimate drift = estimate_drift(grid, fit.shape, fit.white_sd_dps, {}, residual);
  const Eigen::VectorXd course = drift.mean_dps + slow.known_bins();
  rig::EmpiricalTerm term = term_for(axis);
  term.driver = rig::EmpiricalDriver::campaign_time;
  const auto n = grid.t_s.size();
  const std::size_t together = (n + knots_max - 1) / knots_max;
  for (std::size_t first = 0; first < n; first += together) {
    const std::size_t size = std::min(together, n - first);
    double at = 0, dps = 0;
    for (std::size_t k = first; k < first + size; ++k) {
      at += grid.t_s[k] / static_cast<double>(size);
      dps += course(static_cast<Eigen::Index>(k)) / static_cast<double>(size);
    }
    term.at.push_back(at);
    term.dps.push_back(dps);
  }
  return term;
}

/// What has no name, as terms of the rig model.
void add_unexplained(rig::RigModel& model, const SlowModel& slow,
                     const std::vector<SlowFinding>& story, std::size_t axis) {
  std::size_t courses = 0;
  for (const SlowFinding& finding : story) courses += finding.courses.size();
  Eigen::Index next = slow.fit().coefficients.size() -
                      static_cast<Eigen::Index>(courses);  // the last of the shapes
  bool followed = false;
  for (const SlowFinding& finding : story) {
    std::vector<double> sum(slow.track().record.size(), 0.0);
    for (const auto& course : finding.courses) {
      const double amplitude = slow.fit().coefficients(next++);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += amplitude * course[i];
    }
    if (finding.effect != "unknown") continue;
    if (!finding.courses.empty()) {
      model.unexplained.push_back(as_term(finding, sum, slow.track(), axis));
    } else if (!std::exchange(followed, true)) {
      model.unexplained.push_back(followed_drift(slow, axis));
    }
  }
}

/// A line or a growth of the noise without a name.
void add_unexplained_in_samples(rig::RigModel& model, const Finding& finding, const Track& track,
                                std::size_t axis) {
  if (finding.effect != "unknown") return;
  rig::EmpiricalTerm term = term_for(axis);
  constexpr int steps = 24;
  if (finding.law == "line") {
    term.driver = rig::EmpiricalDriver::phase;
    term.period_s = 1 / finding.parameters.front().second;
    for (int k = 0; k <= steps; ++k) {
      term.at.push_back(static_cast<double>(k) / steps);
      term.dps.push_back(finding.amplitude * std::sin(2 * std::numbers::pi * term.at.back()));
    }
    model.unexplained.push_back(std::move(term));
  } else if (finding.law == "spread_over_time") {
    term.driver = rig::EmpiricalDriver::campaign_time;
    const double end_s = track.record.back().t_s;
    for (int k = 0; k <= steps; ++k) {
      term.at.push_back(end_s * k / steps);
      const double hours = term.at.back() / 3600 - finding.parameters.back().second;
      term.noise_factor.push_back(std::exp(finding.amplitude / 100 * hours));
    }
    model.unexplained.push_back(std::move(term));
  }
}

bool is_that(const rig::EmpiricalTerm& term, const Finding& finding) {
  if (finding.law == "line" && rig::is_line(term)) {
    return std::abs(1 / term.period_s - finding.parameters.front().second) < same_line_hz;
  }
  if (finding.law == "spread_over_time" && !term.noise_factor.empty()) {
    const double hours = (term.at.back() - term.at.front()) / 3600;
    const double known =
        100 * std::log(term.noise_factor.back() / term.noise_factor.front()) / hours;
    return std::abs(finding.amplitude - known) <=
           std::max(4 * finding.standard_error, 0.25 * std::abs(known));
  }
  return false;
}

}  // namespace

double give_known_effects(std::span<const rig::Instance> instances, const rig::RigModel& model,
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
    if (!term.axes[axis] || rig::is_line(term)) continue;
    for (std::size_t i = 0; i < course.size(); ++i) course[i] += rig::drift_dps(term, record[i]);
  }
  slow.set_noise(family);
  slow.refit();
  const double without = slow.fit().log_likelihood;
  slow.set_known(course);
  slow.refit();
  return std::max(0.0, slow.fit().log_likelihood - without);
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

bool already_modelled(const Finding& finding, std::span<const rig::Instance> instances,
                      std::span<const rig::EmpiricalTerm> unexplained) {
  if (finding.effect == "unknown") {
    return std::any_of(unexplained.begin(), unexplained.end(),
                       [&](const rig::EmpiricalTerm& term) { return is_that(term, finding); });
  }
  return std::any_of(instances.begin(), instances.end(), [&](const rig::Instance& instance) {
    if (instance.effect->name != finding.effect) return false;
    if (instance.law->info.name == "single") return true;  // its number is a code, not a share
    const double off = std::abs(finding.amplitude - instance.values[0]);
    return off <= std::max(4 * finding.standard_error, 0.25 * std::abs(instance.values[0]));
  });
}

rig::RigModel fast_part(const rig::RigModel& model) {
  rig::RigModel fast = model;
  std::erase_if(fast.unexplained, [](const rig::EmpiricalTerm& term) {
    return term.noise_factor.empty() && !rig::is_line(term);
  });
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
                            const std::vector<SlowFinding>& story,
                            const std::vector<Finding>& findings, const CodeFindings& codes,
                            std::size_t axis) {
  const Track& track = slow.track();
  rig::RigModel model = given;
  model.parent = given.name;
  model.baseline.bias[axis] = slow.bias();
  model.baseline.noise_dps = codes.spread_at_20_dps > 0 ? codes.spread_at_20_dps
                             : codes.white_sd_dps > 0   ? codes.white_sd_dps
                                                        : given.baseline.noise_dps;
  if (track.board_sensor.tau_fitted) model.baseline.board_tau_s = track.board_sensor.tau_s;
  for (const Finding& finding : findings) {
    add_effect(model, finding, axis);
    add_unexplained_in_samples(model, finding, track, axis);
  }
  add_unexplained(model, slow, story, axis);
  return model;
}

}  // namespace gyrocal
