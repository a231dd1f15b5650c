#include "compensation/discrepancy/slow_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/dwell_spectrum.h"
#include "compensation/discrepancy/relaxing_drift.h"
#include "compensation/discrepancy/resonant_drift.h"
#include "compensation/discrepancy/slow_line.h"
#include "compensation/discrepancy/slow_telegraph.h"
#include "compensation/discrepancy/unseen_film.h"

namespace gyrocal {
namespace {

constexpr double telegraph_costs_nats = 6;
constexpr double telegraph_flips_min = 6;
constexpr double regular_nats = 9;
constexpr double regular_nats_per_flip = 0.03;  // short stays are not seen as often as they happen
constexpr double resonance_worth_nats = 10;
constexpr double resonance_lead_nats = 4;

bool is_in(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

SlowOption from_candidate(SlowCandidate candidate) {
  SlowOption option;
  const double cost = parameter_costs_nats * static_cast<double>(candidate.term.values.size() - 1);
  option.score = candidate.nats_same_noise - cost;
  option.beyond_noise = candidate.nats - cost;
  option.finding.effect = candidate.term.effect->name;
  option.finding.law = candidate.term.law->info.name;
  option.finding.amplitude = candidate.term.values[0];
  option.finding.amplitude_sd = candidate.term.amplitude_sd;
  option.finding.term = std::move(candidate.term);
  return option;
}

/// Standard deviation of the logarithm of one ratio, from the curvature of the likelihood.
double log_ratio_sd(const SlowModel& model, const SlowFit& fit, double SlowNoiseShape::*part) {
  const auto at = [&](double factor) {
    SlowNoiseShape shape = fit.shape;
    shape.*part *= factor;
    return fit_given_shape(model.stream().grid(), model.y(), model.design(), shape).log_likelihood;
  };
  constexpr double step = 0.4;
  const double curvature =
      (2 * fit.log_likelihood - at(std::exp(step)) - at(std::exp(-step))) / (step * step);
  return curvature > 0 ? 1 / std::sqrt(curvature) : 1.0;
}

void add_noise(const SlowModel& model, std::vector<SlowOption>& options) {
  const auto& grid = model.stream().grid();
  const auto add = [&](const char* effect, const char* law, const NoiseFamily& family,
                       double SlowNoiseShape::*part, double unit) {
    const SlowFit fit = fit_noise(grid, model.y(), model.design(), family);
    if (fit.shape.*part <= 0) return;
    SlowOption option;
    option.score = fit.log_likelihood - model.fit().log_likelihood;
    option.beyond_noise = option.score;
    option.noise = family;
    option.finding.effect = effect;
    option.finding.law = law;
    option.finding.amplitude = fit.white_sd_dps * std::sqrt(fit.shape.*part) * unit;
    option.finding.amplitude_sd = option.finding.amplitude * log_ratio_sd(model, fit, part) / 2;
    options.push_back(std::move(option));
  };
  NoiseFamily flicker = model.noise(), walk = model.noise();
  flicker.flicker = true;
  walk.walk = true;
  if (!model.noise().flicker) {
    add("bias_instability", "flicker", flicker, &SlowNoiseShape::flicker_ratio, 3600);
  }
  if (!model.noise().walk) {
    add("rate_random_walk", "walk", walk, &SlowNoiseShape::walk_ratio, 1000);
  }
}

/// Noise with a time scale of its own is none of the catalogue's: where it does better than all
/// that flicker and walk can, they lose their names. It keeps the family of the best of them, which
/// follows its course well enough.
void add_resonance(const SlowModel& model, std::vector<SlowOption>& options) {
  if (model.noise_gain_nats() < resonance_worth_nats) return;
  const ResonantDrift fit = fit_resonant_drift(model);
  if (fit.log_likelihood - model.fit_free().log_likelihood < resonance_lead_nats) return;
  const SlowOption* noise = nullptr;
  for (const SlowOption& option : options) {
    const bool follows = option.noise.flicker || option.noise.walk;
    if (follows && (noise == nullptr || option.score > noise->score)) noise = &option;
  }
  if (noise == nullptr) return;
  SlowOption option;
  option.score = fit.log_likelihood - model.fit().log_likelihood - 2 * parameter_costs_nats;
  option.beyond_noise = option.score;
  option.noise = noise->noise;
  option.finding.effect = "unknown";
  option.finding.law = "resonant_noise";
  option.finding.amplitude = fit.sd_dps;
  option.finding.amplitude_sd = fit.sd_dps / std::sqrt(2 * fit.turns);
  option.finding.parameters = {{"period_s", fit.period_s}, {"quality", fit.quality}};
  option.finding.unknown_driver = "time";
  option.finding.description = fmt::format(
      "a drift of {:.3g} mdps rms that follows no temperature and has a time scale of its own "
      "(period {:.3g} s, quality {:.2g}), which neither flicker nor a random walk has ({:.1f} nats "
      "over both)",
      fit.sd_dps * 1000, fit.period_s, fit.quality,
      fit.log_likelihood - model.fit_free().log_likelihood);
  options.push_back(std::move(option));
}

/// What two levels gain over the Gaussian noise of their spectrum is seen in the rows; what that
/// noise gains, in the bins, where it is held against all other noise.
void add_telegraph(const SlowModel& model, std::vector<SlowOption>& options) {
  const double noise_gain = model.noise_gain_nats();
  // What no noise helps has no telegraph in it either: its spectrum is a Lorentzian.
  if (noise_gain < 2) return;
  if (model.noise().flicker || model.noise().walk) return;
  double gaussian = noise_gain;
  for (const SlowOption& option : options) {
    if (option.finding.law == "resonant_noise") gaussian = std::max(gaussian, option.score);
  }
  const SlowTelegraph fit = fit_slow_telegraph(model);
  if (fit.flips < telegraph_flips_min) return;
  if (fit.regular_nats > regular_nats + regular_nats_per_flip * fit.flips) return;
  SlowOption option;
  const double same_spectrum =
      relaxing_log_likelihood(model.stream().grid(), model.y(), model.design()) -
      model.fit().log_likelihood;
  option.score = same_spectrum + fit.lead_nats - telegraph_costs_nats;
  option.beyond_noise = option.score - gaussian;
  option.known_bins = fit.level_dps * (fit.high.array() - 0.5).matrix();
  option.finding.effect = "random_telegraph_noise";
  option.finding.law = "two_levels";
  option.finding.amplitude = fit.level_dps * 1000;
  option.finding.amplitude_sd = fit.level_sd_dps * 1000;
  option.finding.parameters = {{"low", fit.low_dwell_s}, {"high", fit.high_dwell_s}};
  options.push_back(std::move(option));
}

struct MainsAlias {
  double grid_hz = 0;
  double clock_ppm = 0;
};

/// The mains frequency whose alias could be this slow, if the clock may be off by 1500 ppm.
std::optional<MainsAlias> mains_alias(double f_hz, double sample_rate_hz) {
  constexpr double clock_ppm_max = 1500, clock_ppm_min = 20;
  for (const double grid_hz : {50.0, 60.0}) {
    if (folded_hz(grid_hz, sample_rate_hz) > 0.02) continue;
    const double ppm = f_hz / grid_hz * 1e6;
    if (ppm >= clock_ppm_min && ppm <= clock_ppm_max) return MainsAlias{grid_hz, ppm};
  }
  return std::nullopt;
}

void add_line(const SlowModel& model, double sample_rate_hz, std::vector<SlowOption>& options) {
  auto line = find_slow_line(model);
  if (!line) return;
  SlowOption option;
  option.score = line->nats_same_noise;
  option.beyond_noise = line->nats;
  option.finding.courses = {line->courses[0], line->courses[1]};
  if (const auto mains = mains_alias(line->f_hz, sample_rate_hz)) {
    option.finding.effect = "mains_hum";
    option.finding.law = "steady";
    option.finding.amplitude = line->amplitude_dps * 1000;
    option.finding.amplitude_sd = line->amplitude_sd_dps * 1000;
    option.finding.parameters = {{"f", mains->grid_hz}, {"clock", mains->clock_ppm}, {"second", 0}};
  } else {
    option.finding.effect = "unknown";
    option.finding.law = "sine";
    option.finding.amplitude = line->amplitude_dps;
    option.finding.amplitude_sd = line->amplitude_sd_dps;
    option.finding.parameters = {{"period_s", 1 / line->f_hz}};
    option.finding.unknown_driver = "time, periodic";
    option.finding.description = fmt::format(
        "a sine in time with a period of {:.4g} s and an amplitude of {:.3g} mdps, in step over "
        "the "
        "whole record whatever the temperature does",
        1 / line->f_hz, line->amplitude_dps * 1000);
  }
  options.push_back(std::move(option));
}

}  // namespace

std::vector<SlowOption> slow_options(const SlowModel& model, double sample_rate_hz,
                                     const std::vector<std::string>& excluded,
                                     const Executor& run_all) {
  std::vector<SlowOption> options;
  for (SlowCandidate& candidate : search_effects(model, run_all)) {
    options.push_back(from_candidate(thinnest_film(model, std::move(candidate))));
  }
  add_noise(model, options);
  add_resonance(model, options);
  add_telegraph(model, options);
  add_line(model, sample_rate_hz, options);
  std::erase_if(options,
                [&](const SlowOption& option) { return is_in(option.finding.effect, excluded); });
  std::stable_sort(options.begin(), options.end(),
                   [](const SlowOption& a, const SlowOption& b) { return a.score > b.score; });
  return options;
}

}  // namespace gyrocal
