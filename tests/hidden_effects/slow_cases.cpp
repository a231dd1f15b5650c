#include "tests/hidden_effects/slow_cases.h"

#include <algorithm>
#include <cmath>

#include "tests/hidden_effects/planted.h"

namespace hidden {
namespace {

double step_factor(const std::string& level, Random& random) {
  return level == "strong" ? random.uniform(5.0, 10.0) : random.uniform(2.5, 3.0);
}

Wanted wanted_for(const std::string& name) {
  Wanted wanted;
  wanted.plans = telling_plans(name);
  wanted.white_dps_max = 0.35;
  if (name == "aging_drift" || name == "self_heating") wanted.white_dps_max = 0.12;
  if (name == "thermal_lag" || name == "self_heating") wanted.slope_scale = 2.0;
  wanted.every_column = name != "bias_jump" && name != "mode_crossing";
  return wanted;
}

constexpr int tries = 25;

}  // namespace

std::vector<std::string> telling_plans(const std::string& name) {
  if (name == "aging_drift" || name == "self_heating") return {"shuffled", "up_revisit", "up_down"};
  if (name == "thermal_hysteresis") return {"up_down", "shuffled", "coarse"};
  if (name == "thermal_lag") return {"up_down", "shuffled"};
  return {"up", "up_down", "shuffled", "up_revisit", "coarse"};
}

Case slow_single(const std::string& name, const std::string& level, std::uint64_t seed,
                 double sigma_over_lsb_min) {
  Random random(seed);
  const auto laws = laws_of(name);
  Case best;
  double best_lead = -1e9;
  for (int attempt = 0; attempt < tries && best_lead < 10.0; ++attempt) {
    Wanted wanted = wanted_for(name);
    wanted.sigma_over_lsb_min = sigma_over_lsb_min;
    const Setting setting = draw_setting(wanted, random);
    const Trajectory plain = setting.trajectory(setting.chain);
    const SlowLaw law = draw_law(
        name, laws[(seed + static_cast<std::uint64_t>(attempt)) % laws.size()], plain, random);
    const Planted planted = plant(law, setting, plain, step_factor(level, random), {}, random);
    const double lead = possible(planted) ? planted.seen.smallest_lead() : -1e8;
    if (lead <= best_lead) continue;
    best_lead = lead;
    best = assembled(setting, {planted}, seed);
  }
  best.category = "single";
  best.level = level;
  best.expected_verdict = "explained";
  best.accepted_verdicts = {"explained"};
  if (best_lead < 5.0) best.accepted_verdicts.emplace_back("confounded");
  return best;
}

Case slow_pair(const std::string& first, const std::string& second, std::uint64_t seed) {
  Random random(seed);
  Case best;
  double best_lead = -1e9;
  for (int attempt = 0; attempt < tries && best_lead < 10.0; ++attempt) {
    Wanted wanted = wanted_for(first);
    wanted.plans = {"up_down", "shuffled"};
    wanted.white_dps_max = 0.12;
    wanted.every_column = true;
    const Setting setting = draw_setting(wanted, random);
    const Trajectory plain = setting.trajectory(setting.chain);
    const SlowLaw law_one = draw_law(first, random.pick(laws_of(first)), plain, random);
    const SlowLaw law_two = draw_law(second, random.pick(laws_of(second)), plain, random);
    const double guess = law_one.name == "thermal_lag" ? 60.0 : 1.0;
    const Planted two = plant(law_two, setting, plain, random.uniform(5.0, 8.0),
                              {signature(law_one, setting, plain, guess)}, random);
    const Planted one =
        plant(law_one, setting, plain, random.uniform(5.0, 8.0), {two.signature_dps}, random);
    const double lead = possible(one) && possible(two)
                            ? std::min(one.seen.smallest_lead(), two.seen.smallest_lead())
                            : -1e8;
    if (lead <= best_lead) continue;
    best_lead = lead;
    best = assembled(setting, {one, two}, seed);
  }
  best.category = "pair";
  best.level = "strong";
  best.expected_verdict = "explained";
  best.accepted_verdicts = {"explained"};
  return best;
}

Case outsider_case(const std::string& law_name, std::uint64_t seed) {
  Random random(seed);
  Case best;
  double best_lead = -1e9;
  for (int attempt = 0; attempt < tries && best_lead < 25.0; ++attempt) {
    Wanted wanted;
    wanted.plans = {"up", "up_down", "shuffled", "up_revisit"};
    wanted.white_dps_max = 0.35;
    wanted.every_column = law_name == "rate_squared";
    if (law_name == "growing_leak") wanted.plans = {"up_down", "shuffled"};
    const Setting setting = draw_setting(wanted, random);
    const Trajectory plain = setting.trajectory(setting.chain);
    const Planted planted = plant(draw_outsider(law_name, plain, random), setting, plain,
                                  random.uniform(5.0, 9.0), {}, random);
    const double lead = planted.seen.smallest_lead();
    if (lead <= best_lead) continue;
    best_lead = lead;
    best = assembled(setting, {planted}, seed);
  }
  best.category = "outside";
  best.level = "strong";
  best.expected_verdict = "unexplained";
  best.accepted_verdicts = {"unexplained"};
  if (best_lead < 10.0) best.accepted_verdicts.emplace_back("confounded");
  return best;
}

Case confounded_case(const std::string& name, const std::vector<std::string>& plans, bool straight,
                     std::uint64_t seed) {
  Random random(seed);
  const auto laws = laws_of(name);
  Case best;
  double best_distance = 1e9;
  for (int attempt = 0; attempt < 8 && best_distance > 5.0; ++attempt) {
    Wanted wanted = wanted_for(name);
    wanted.plans = plans;
    wanted.straight = straight;
    const Setting setting = draw_setting(wanted, random);
    const Trajectory plain = setting.trajectory(setting.chain);
    const SlowLaw law = draw_law(name, random.pick(laws), plain, random);
    Planted planted = plant(law, setting, plain, random.uniform(1.3, 3.5), {}, random);
    if (name == "temperature_rate" || name == "stress_relaxation") {
      // Against the slope of the bias, as a lag works: a negative time constant is no rival.
      planted.amplitude = -std::copysign(planted.amplitude, setting.baseline.linear_dps);
    }
    const bool fit = possible(planted) && planted.seen.gain_nats >= 18.0;
    const double distance = std::abs(planted.seen.smallest_lead()) + (fit ? 0.0 : 1e6);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = assembled(setting, {planted}, seed);
  }
  auto& truth = best.effects.front();
  if (truth.confounded_with.empty()) {  // the nearest, if none is near
    truth.confounded_with.push_back(
        std::min_element(truth.lead_nats.begin(), truth.lead_nats.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first);
  }
  best.category = "confounded";
  best.level = "strong";
  best.expected_verdict = "confounded";
  best.accepted_verdicts = {"confounded"};
  if (best_distance > 3.0) best.accepted_verdicts.emplace_back("explained");
  return best;
}

}  // namespace hidden
