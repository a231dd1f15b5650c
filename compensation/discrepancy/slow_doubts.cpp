#include "compensation/discrepancy/slow_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_fit.h"

namespace gyrocal {
namespace {

bool rate_could_be_lag(const SlowModel& model, const SlowOption& rate) {
  constexpr double tau_s_max = 900;
  std::vector<double> course;
  for (const rig::Drivers& now : model.track().record) {
    course.push_back(-model.bias().slope(now.die_c) * now.die_rate_c_per_min / 60);
  }
  Eigen::MatrixXd design(model.y().size(), model.design().cols() + 1);
  design << model.design(), model.stream().bin(course);
  const SlowFit fit =
      refit_noise(model.stream().grid(), model.y(), design, model.noise(), model.fit().shape);
  const double tau_s = fit.coefficients.tail(1)(0);
  return tau_s > 0 && tau_s < tau_s_max &&
         fit.log_likelihood - model.fit().log_likelihood > rate.score - lead_to_name_nats;
}

}  // namespace

bool is_noise(const SlowOption& option) { return option.noise.flicker || option.noise.walk; }

bool is_unknown(const SlowOption& option) { return option.finding.effect == "unknown"; }

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

void doubt_rate(const SlowModel& model, SlowOption& option) {
  auto& rivals = option.finding.rivals;
  if (option.finding.effect != "temperature_rate" || !rate_could_be_lag(model, option) ||
      std::count(rivals.begin(), rivals.end(), "thermal_lag") > 0) {
    return;
  }
  rivals.push_back("thermal_lag");
  option.finding.lead_nats = std::min(option.finding.lead_nats, lead_to_name_nats);
}

}  // namespace gyrocal
