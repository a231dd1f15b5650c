#include "tests/hidden_effects/slow_cases.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/hidden_effects/identifiability.h"

namespace hidden {
namespace {

/// A law put into a setting at some amplitude, with what it then does to the slow stream.
struct Planted {
  SlowLaw law;
  double amplitude;
  Series signature_dps;  ///< at amplitude one (for heat laws: linearised at the amplitude)
  double smallest;       ///< detectable amplitude
  Visibility seen;
};

Series minus_baseline(const Setting& setting, const Trajectory& over, double amplitude) {
  Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i) {
    series[i] = (setting.baseline(over.felt_c[i]) - setting.baseline(over.die_c[i])) / amplitude;
  }
  return series;
}

Series signature(const SlowLaw& law, const Setting& setting, const Trajectory& plain,
                 double amplitude) {
  if (!law.heat) return law.shape(plain);
  Chain chain = setting.chain;
  law.heat(chain, amplitude);
  return minus_baseline(setting, setting.trajectory(chain), amplitude);
}

double step_factor(const std::string& level, Random& random) {
  return level == "strong" ? random.uniform(5.0, 10.0) : random.uniform(2.5, 3.0);
}

Planted plant(const SlowLaw& law, const Setting& setting, const Trajectory& plain, double factor,
              const std::vector<Series>& known, Random& random) {
  const auto look = [&](const Series& at_one) {
    return Sight(plain, setting.baseline, at_one, law.name, setting.white_per_root_hz(), known);
  };
  const double guess = law.name == "thermal_lag" ? 60.0 : 1.0;
  Planted planted{law, 0.0, signature(law, setting, plain, guess), 0.0, {}};
  Sight sight = look(planted.signature_dps);
  planted.smallest = sight.smallest_amplitude();
  planted.amplitude = factor * planted.smallest * (law.heat ? 1.0 : random.sign());
  if (law.heat && planted.amplitude < law.amplitude_high) {  // not linear: look again at its size
    planted.signature_dps = signature(law, setting, plain, planted.amplitude);
    sight = look(planted.signature_dps);
  }
  planted.seen = sight.at(planted.amplitude);
  return planted;
}

bool possible(const Planted& planted) {
  const double size = std::abs(planted.amplitude);
  return size >= planted.law.amplitude_low && size <= planted.law.amplitude_high;
}

Hidden as_truth(const Planted& planted) {
  Hidden truth;
  truth.name = planted.law.name;
  truth.law = planted.law.law;
  truth.amplitude = {planted.amplitude, planted.law.unit, planted.law.amplitude_means};
  truth.signed_amplitude = planted.law.signed_amplitude;
  truth.parameters = planted.law.parameters;
  truth.smallest_detectable = planted.smallest;
  truth.gain_nats = planted.seen.gain_nats;
  truth.lead_nats = planted.seen.lead_nats;
  truth.confounded_with = planted.seen.rivals_within(5.0);
  if (truth.name == "self_heating") {  // one class, two ways to say how large
    const auto furthest =
        std::max_element(planted.signature_dps.begin(), planted.signature_dps.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (planted.law.heat) {
      truth.also.push_back({planted.amplitude * *furthest, "dps", "largest change of the bias"});
    }
  }
  return truth;
}

Case assembled(const Setting& setting, const std::vector<Planted>& planted, std::uint64_t seed) {
  Case made;
  made.seed = seed;
  made.setting = setting;
  made.chain = setting.chain;
  for (const auto& each : planted) {
    made.effects.push_back(as_truth(each));
    if (each.law.heat) each.law.heat(made.chain, each.amplitude);
  }
  made.over = setting.trajectory(made.chain);
  made.added_dps.assign(made.over.seconds(), 0.0);
  for (const auto& each : planted) {
    if (!each.law.shape) continue;
    const Series shape = each.law.shape(made.over);
    for (std::size_t i = 0; i < shape.size(); ++i) made.added_dps[i] += each.amplitude * shape[i];
  }
  made.flicker_dps = weak_flicker_dps(setting, made.over);
  return made;
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

double weak_flicker_dps(const Setting& setting, const Trajectory& over) {
  const double bin_s = static_cast<double>(over.seconds()) / 400.0;
  return 0.12 * setting.flicker_share * setting.white_per_root_hz() / std::sqrt(bin_s);
}

Case slow_single(const std::string& name, const std::string& level, std::uint64_t seed) {
  Random random(seed);
  const auto laws = laws_of(name);
  Case best;
  double best_lead = -1e9;
  for (int attempt = 0; attempt < tries && best_lead < 10.0; ++attempt) {
    const Setting setting = draw_setting(wanted_for(name), random);
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
  for (int attempt = 0; attempt < tries && best_distance > 2.0; ++attempt) {
    Wanted wanted = wanted_for(name);
    wanted.plans = plans;
    wanted.straight = straight;
    const Setting setting = draw_setting(wanted, random);
    const Trajectory plain = setting.trajectory(setting.chain);
    const SlowLaw law = draw_law(name, random.pick(laws), plain, random);
    const Planted planted = plant(law, setting, plain, random.uniform(1.2, 4.0), {}, random);
    if (!possible(planted) || planted.seen.gain_nats < 18.0) continue;
    const double distance = std::abs(planted.seen.smallest_lead());
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = assembled(setting, {planted}, seed);
  }
  best.category = "confounded";
  best.level = "strong";
  best.expected_verdict = "confounded";
  best.accepted_verdicts = {"confounded"};
  if (best_distance > 3.5) best.accepted_verdicts.emplace_back("explained");
  return best;
}

}  // namespace hidden
