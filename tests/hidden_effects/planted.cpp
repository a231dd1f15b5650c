#include "tests/hidden_effects/planted.h"

#include <algorithm>
#include <cmath>

namespace hidden {
namespace {

Series minus_baseline(const Setting& setting, const Trajectory& over, double amplitude) {
  Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i) {
    series[i] = (setting.baseline(over.felt_c[i]) - setting.baseline(over.die_c[i])) / amplitude;
  }
  return series;
}

/// Fair ways to state the same size in another unit.
std::vector<Amplitude> other_ways(const Planted& planted, const Setting& setting, double seconds) {
  if (planted.law.name == "aging_drift") {
    return {{1e-3 * planted.amplitude * seconds / 3600.0, "dps", "whole drift of the session"}};
  }
  if (planted.law.name != "self_heating") return {};
  if (planted.law.heat) {  // one class, two ways to say how large
    const auto furthest =
        std::max_element(planted.signature_dps.begin(), planted.signature_dps.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); });
    return {{planted.amplitude * *furthest, "dps", "largest change of the bias"}};
  }
  const double start_c = setting.plan.start_c;
  const double slope = setting.baseline(start_c + 0.5) - setting.baseline(start_c - 0.5);
  return {{-planted.amplitude / slope, "degC", "warming that would do the same at the start"}};
}

Hidden as_truth(const Planted& planted, const Setting& setting, double seconds) {
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
  truth.also = other_ways(planted, setting, seconds);
  return truth;
}

}  // namespace

double weak_flicker_dps(const Setting& setting, const Trajectory& over) {
  const double bin_s = static_cast<double>(over.seconds()) / 400.0;
  return 0.12 * setting.flicker_share * setting.white_per_root_hz() / std::sqrt(bin_s);
}

Series signature(const SlowLaw& law, const Setting& setting, const Trajectory& plain,
                 double amplitude) {
  if (!law.heat) return law.shape(plain);
  Chain chain = setting.chain;
  law.heat(chain, amplitude);
  return minus_baseline(setting, setting.trajectory(chain), amplitude);
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

Case assembled(const Setting& setting, const std::vector<Planted>& planted, std::uint64_t seed) {
  Case made;
  made.seed = seed;
  made.setting = setting;
  made.chain = setting.chain;
  for (const auto& each : planted) {
    if (each.law.heat) each.law.heat(made.chain, each.amplitude);
  }
  made.over = setting.trajectory(made.chain);
  for (const auto& each : planted) {
    made.effects.push_back(as_truth(each, setting, static_cast<double>(made.over.seconds())));
  }
  made.added_dps.assign(made.over.seconds(), 0.0);
  for (const auto& each : planted) {
    if (!each.law.shape) continue;
    const Series shape = each.law.shape(made.over);
    for (std::size_t i = 0; i < shape.size(); ++i) made.added_dps[i] += each.amplitude * shape[i];
  }
  made.flicker_dps = weak_flicker_dps(setting, made.over);
  return made;
}

}  // namespace hidden
