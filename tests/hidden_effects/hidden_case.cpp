#include "tests/hidden_effects/hidden_case.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/hidden_effects/noise.h"
#include "tests/hidden_effects/session_files.h"

namespace hidden {
namespace {

using Json = nlohmann::ordered_json;

Series bias_series(const Case& of, Random& random) {
  const std::size_t n = of.over.seconds();
  const Series flicker = flicker_noise(n, of.flicker_dps, random);
  const Series walk = random_walk(n, of.walk_dps_per_root_s, 1.0, random);
  Series bias(n);
  for (std::size_t i = 0; i < n; ++i) {
    bias[i] = of.setting.baseline(of.over.felt_c[i]) + flicker[i] + walk[i] +
              (of.added_dps.empty() ? 0.0 : of.added_dps[i]);
  }
  return bias;
}

void cut_gaps(Measured& measured, int gaps, Random& random) {
  for (int k = 0; k < gaps; ++k) {
    const double from_s = random.uniform(0.05, 0.95) * measured.monitor.back().t_s;
    const double to_s = from_s + random.uniform(60.0, 900.0);
    std::erase_if(measured.monitor,
                  [&](const MonitorRow& r) { return r.t_s > from_s && r.t_s < to_s; });
  }
}

/// The true share of what a sensor fault did in the dwells, known only now.
void fill_shares(Case& of, const Measured& measured) {
  const Tally& tally = measured.in_dwells;
  const std::map<std::string, double> share = {{"outlier_glitches", tally.glitched / tally.all},
                                               {"stuck_samples", tally.stuck / tally.all},
                                               {"dropped_samples", tally.lost / tally.all},
                                               {"saturation", tally.at_rail / tally.all}};
  for (auto& effect : of.effects) {
    if (const auto found = share.find(effect.name); found != share.end()) {
      effect.amplitude.value = found->second;
    }
    if (effect.name == "missing_codes") {
      effect.also.push_back({tally.displaced / tally.all, "share_of_samples", "samples displaced"});
    }
  }
}

Json amplitude_json(const Amplitude& amplitude) {
  return {{"amplitude", amplitude.value}, {"unit", amplitude.unit}, {"means", amplitude.means}};
}

Json effect_json(const Hidden& effect) {
  Json json = {{"effect", effect.name}, {"law", effect.law}};
  json.update(amplitude_json(effect.amplitude));
  json["also"] = Json::array();
  for (const auto& other : effect.also) json["also"].push_back(amplitude_json(other));
  json["signed"] = effect.signed_amplitude;
  json["parameters"] = effect.parameters;
  json["smallest_detectable"] = effect.smallest_detectable;
  json["gain_nats"] = effect.gain_nats;
  json["lead_nats"] = effect.lead_nats;
  json["confounded_with"] = effect.confounded_with;
  return json;
}

Json truth_json(const Case& of, const std::filesystem::path& folder) {
  const Setting& setting = of.setting;
  Json json = {{"format", "gyrocal-hidden-truth/1"},
               {"case", of.name},
               {"session", folder.filename().string()},
               {"category", of.category},
               {"level", of.level},
               {"seed", of.seed},
               {"expected_verdict", of.expected_verdict},
               {"accepted_verdicts", of.accepted_verdicts},
               {"effects", Json::array()}};
  for (const auto& effect : of.effects) json["effects"].push_back(effect_json(effect));
  json["plan"] = {{"kind", setting.plan.kind},
                  {"setpoints", setting.plan.setpoints_c.size()},
                  {"hours", static_cast<double>(of.over.seconds()) / 3600.0},
                  {"return_logged", setting.plan.log_return},
                  {"monitor_gaps", setting.monitor_gaps}};
  json["noise"] = {{"white_dps", setting.sensor.white_dps},
                   {"lsb_dps", setting.sensor.lsb_dps},
                   {"flicker_deg_per_h", of.flicker_dps * 3600.0},
                   {"walk_mdps_per_root_s", of.walk_dps_per_root_s * 1e3}};
  json["thermal"] = {{"board_tau_s", of.chain.board_tau_s}, {"die_tau_s", of.chain.die_tau_s}};
  json["baseline_dps"] = {setting.baseline.at_20c_dps, setting.baseline.linear_dps,
                          setting.baseline.square_dps, setting.baseline.cube_dps};
  return json;
}

}  // namespace

std::string write_case(Case hidden_case, const std::filesystem::path& folder,
                       const std::filesystem::path& truth_file) {
  Random random(hidden_case.seed ^ 0x5eed);
  const Setting& setting = hidden_case.setting;
  const Series bias = bias_series(hidden_case, random);
  Measured measured = measure(setting.sensor, hidden_case.over, bias, hidden_case.tilt_rad,
                              setting.samples_per_dwell, setting.monitor_interval_s, random);
  cut_gaps(measured, setting.monitor_gaps, random);
  fill_shares(hidden_case, measured);
  const SessionHead head{setting.device, setting.axis, setting.monitor_interval_s,
                         setting.samples_per_dwell};
  std::string trouble = write_session(folder, head, setting.sensor, hidden_case.over, measured);
  if (!trouble.empty()) return trouble;
  return write_file(truth_file, truth_json(hidden_case, folder).dump(1) + "\n");
}

}  // namespace hidden
