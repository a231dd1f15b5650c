#include "compensation/discrepancy/slow_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_fit.h"
#include "compensation/rig/thermal_lags.h"

namespace gyrocal {
namespace {

constexpr double noise_costs_nats = 1;
constexpr double tau_s_max = 900;

/// Courses beside the present model, and what they gain at the best of the noises they may have.
struct Alternative {
  SlowFit fit;
  double nats;
};

Alternative with_courses(const SlowModel& model, const std::vector<std::vector<double>>& courses) {
  const Eigen::Index before = model.design().cols();
  Eigen::MatrixXd design(model.y().size(), before + static_cast<Eigen::Index>(courses.size()));
  design.leftCols(before) = model.design();
  for (std::size_t k = 0; k < courses.size(); ++k) {
    design.col(before + static_cast<Eigen::Index>(k)) = model.stream().bin(courses[k]);
  }
  const SlowGrid& grid = model.stream().grid();
  SlowFit same = refit_noise(grid, model.y(), design, model.noise(), model.fit().shape);
  SlowFit free = refit_noise(grid, model.y(), design, all_noise, model.fit_free().shape);
  const double before_nats = model.fit().log_likelihood;
  const double same_nats = same.log_likelihood - before_nats;
  const double free_nats = free.log_likelihood - noise_costs_nats - before_nats;
  if (free_nats > same_nats) return {std::move(free), free_nats};
  return {std::move(same), same_nats};
}

bool nearly_as_good(const SlowModel& model, double nats, const SlowOption& chosen) {
  return nats > with_own_noise(model, chosen) - lead_to_name_nats;
}

bool rate_could_be_lag(const SlowModel& model, const SlowOption& rate) {
  std::vector<double> course;
  for (const rig::Drivers& now : model.track().record) {
    course.push_back(-model.bias().slope(now.die_c) * now.die_rate_c_per_min / 60);
  }
  const Alternative lag = with_courses(model, {course});
  const double tau_s = lag.fit.coefficients.tail(1)(0);
  return tau_s > 0 && tau_s < tau_s_max && nearly_as_good(model, lag.nats, rate);
}

/// A rate that comes late or early by a delay short enough to be a wrong lag of the die's.
bool lag_could_be_early_rate(const SlowModel& model, const SlowOption& lag) {
  const auto& record = model.track().record;
  std::vector<double> rate, change;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const rig::Drivers& before = record[i == 0 ? 0 : i - 1];
    const rig::Drivers& after = record[std::min(i + 1, record.size() - 1)];
    rate.push_back(record[i].die_rate_c_per_min);
    change.push_back((after.die_rate_c_per_min - before.die_rate_c_per_min) /
                     std::max(after.t_s - before.t_s, 1e-9));
  }
  const Alternative late = with_courses(model, {rate, change});
  const double size = late.fit.coefficients.tail(2)(0);
  const double delay_s = -late.fit.coefficients.tail(1)(0) / size;
  const double delay_sd_s = late.fit.standard_error.tail(1)(0) / std::abs(size);
  return std::abs(delay_s) - 2 * delay_sd_s <
             std::max(model.track().die_tau_s, lag.finding.amplitude) &&
         nearly_as_good(model, late.nats - parameter_costs_nats, lag);
}

/// A rate that trails just as the temperature does: over a straight bias the same to the last bit.
bool lag_could_be_trailing_rate(const SlowModel& model, const SlowOption& lag) {
  const auto& record = model.track().record;
  rig::ThermalLag trailing(lag.finding.amplitude, record.front().die_rate_c_per_min);
  double last_s = record.front().t_s;
  std::vector<double> course;
  for (const rig::Drivers& now : record) {
    course.push_back(trailing.advance(now.t_s - last_s, now.die_rate_c_per_min));
    last_s = now.t_s;
  }
  const Alternative late = with_courses(model, {course});
  return nearly_as_good(model, late.nats - parameter_costs_nats, lag);
}

bool relaxation_could_be_lag(const SlowModel& model, const SlowOption& relaxation) {
  const rig::Law& pole = *rig::find_law(*rig::find_effect("thermal_lag"), "pole");
  for (const double tau_s : {tau_s_max, 600.0, 400.0, 250.0, 150.0, 60.0}) {
    const std::vector<double> values{tau_s};
    const Alternative trailing =
        with_courses(model, {rig::drift_over(pole, values, model.bias(), model.track().record)});
    const double share = trailing.fit.coefficients.tail(1)(0);
    if (share > 0 && share <= 1 &&
        nearly_as_good(model, trailing.nats - parameter_costs_nats, relaxation)) {
      return true;
    }
  }
  return false;
}

void doubt(SlowOption& option, const char* rival) {
  auto& rivals = option.finding.rivals;
  if (std::count(rivals.begin(), rivals.end(), rival) > 0) return;
  rivals.emplace_back(rival);
  option.finding.lead_nats = std::min(option.finding.lead_nats, lead_to_name_nats);
}

}  // namespace

double with_own_noise(const SlowModel& model, const SlowOption& option) {
  return std::max(option.score, option.beyond_noise + model.noise_gain_nats() - noise_costs_nats);
}

bool is_noise(const SlowOption& option) { return option.noise.flicker || option.noise.walk; }

bool is_unknown(const SlowOption& option) { return option.finding.effect == "unknown"; }

bool is_curve(const SlowOption& option) {
  return is_unknown(option) && option.finding.law == "curve";
}

SlowOption curve_option(const SmoothGain& gain) {
  SlowOption option;
  option.score = gain.nats;
  option.finding.effect = "unknown";
  option.finding.law = "curve";
  option.finding.amplitude = gain.rms_dps;
  option.finding.evidence_nats = gain.nats;
  option.finding.lead_nats = gain.nats;
  option.finding.unknown_driver = gain.driver;
  option.finding.courses = {gain.curve};
  option.finding.parameters = {{"peak_dps", gain.peak_dps}, {"peak_at", gain.peak_at}};
  option.finding.description = fmt::format(
      "a drift that follows {} ({:.3g} mdps rms, largest {:+.3g} mdps at {:.4g} {}); no effect of "
      "the catalogue has this shape",
      gain.driver, gain.rms_dps * 1000, gain.peak_dps * 1000, gain.peak_at, gain.unit);
  return option;
}

bool curve_beats_name(const SmoothGain& curve, const SlowOption& option) {
  return option.finding.term && curve.nats > curve_over_name * option.beyond_noise + gate_nats;
}

bool curve_beats_chance(const SmoothGain& curve, const SlowOption& option) {
  if (is_noise(option)) return curve.nats > unknown_gate_nats;
  return option.finding.effect == "random_telegraph_noise" &&
         curve.nats > std::max(unknown_gate_nats, option.beyond_noise);
}

void doubt_lags(const SlowModel& model, SlowOption& option) {
  const std::string& name = option.finding.effect;
  if (name == "temperature_rate" && rate_could_be_lag(model, option)) doubt(option, "thermal_lag");
  if (name == "stress_relaxation" && relaxation_could_be_lag(model, option)) {
    doubt(option, "thermal_lag");
  }
  if (name == "thermal_lag" &&
      (lag_could_be_early_rate(model, option) || lag_could_be_trailing_rate(model, option))) {
    doubt(option, "temperature_rate");
  }
}

}  // namespace gyrocal
