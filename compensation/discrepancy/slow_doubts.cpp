#include "compensation/discrepancy/slow_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_fit.h"

namespace gyrocal {
namespace {

SlowFit with_courses(const SlowModel& model, const std::vector<std::vector<double>>& courses) {
  const Eigen::Index before = model.design().cols();
  Eigen::MatrixXd design(model.y().size(), before + static_cast<Eigen::Index>(courses.size()));
  design.leftCols(before) = model.design();
  for (std::size_t k = 0; k < courses.size(); ++k) {
    design.col(before + static_cast<Eigen::Index>(k)) = model.stream().bin(courses[k]);
  }
  return refit_noise(model.stream().grid(), model.y(), design, model.noise(), model.fit().shape);
}

bool nearly_as_good(const SlowModel& model, const SlowFit& fit, double cost_nats,
                    const SlowOption& chosen) {
  return fit.log_likelihood - model.fit().log_likelihood - cost_nats >
         chosen.score - lead_to_name_nats;
}

bool rate_could_be_lag(const SlowModel& model, const SlowOption& rate) {
  constexpr double tau_s_max = 900;
  std::vector<double> course;
  for (const rig::Drivers& now : model.track().record) {
    course.push_back(-model.bias().slope(now.die_c) * now.die_rate_c_per_min / 60);
  }
  const SlowFit fit = with_courses(model, {course});
  const double tau_s = fit.coefficients.tail(1)(0);
  return tau_s > 0 && tau_s < tau_s_max && nearly_as_good(model, fit, 0, rate);
}

bool lag_could_be_rate(const SlowModel& model, const SlowOption& lag) {
  constexpr double delay_costs_nats = 1;
  const auto& record = model.track().record;
  std::vector<double> rate, change;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const rig::Drivers& before = record[i == 0 ? 0 : i - 1];
    const rig::Drivers& after = record[std::min(i + 1, record.size() - 1)];
    rate.push_back(record[i].die_rate_c_per_min);
    change.push_back((after.die_rate_c_per_min - before.die_rate_c_per_min) /
                     std::max(after.t_s - before.t_s, 1e-9));
  }
  const SlowFit fit = with_courses(model, {rate, change});
  const double delay_s = -fit.coefficients.tail(1)(0) / fit.coefficients.tail(2)(0);
  return std::abs(delay_s) < std::max(model.track().die_tau_s, lag.finding.amplitude) &&
         nearly_as_good(model, fit, delay_costs_nats, lag);
}

void doubt(SlowOption& option, const char* rival) {
  auto& rivals = option.finding.rivals;
  if (std::count(rivals.begin(), rivals.end(), rival) > 0) return;
  rivals.emplace_back(rival);
  option.finding.lead_nats = std::min(option.finding.lead_nats, lead_to_name_nats);
}

}  // namespace

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

void doubt_ramps(const SlowModel& model, SlowOption& option) {
  const std::string& name = option.finding.effect;
  if (name == "temperature_rate" && rate_could_be_lag(model, option)) doubt(option, "thermal_lag");
  if (name == "thermal_lag" && lag_could_be_rate(model, option)) doubt(option, "temperature_rate");
}

}  // namespace gyrocal
