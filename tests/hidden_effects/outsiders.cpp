// Effects that stand in no catalogue: what a finder must admit it does not know.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/hidden_effects/slow_laws.h"

namespace hidden {
namespace {

using OfSecond = std::function<double(const Trajectory&, std::size_t)>;

SlowLaw outsider(const std::string& law, std::map<std::string, double> parameters, OfSecond value) {
  SlowLaw unknown;
  unknown.name = "unknown";
  unknown.law = law;
  unknown.unit = "dps";
  unknown.amplitude_means = "scale of the term it adds to the bias";
  unknown.parameters = std::move(parameters);
  unknown.shape = [value = std::move(value)](const Trajectory& over) {
    Series series(over.seconds());
    for (std::size_t i = 0; i < series.size(); ++i) series[i] = value(over, i);
    return series;
  };
  return unknown;
}

SlowLaw supply_ripple(Random& random) {
  const double period_s = random.log_uniform(700.0, 3300.0);
  const double phase = random.uniform(0.0, full_turn);
  return outsider("supply_ripple", {{"period_s", period_s}}, [=](const Trajectory&, std::size_t i) {
    const double angle = full_turn * static_cast<double>(i) / period_s + phase;
    return 0.5 * std::sin(angle) + 0.1 * std::sin(2.0 * angle + 1.0);
  });
}

/// A leak that doubles every few degrees and grows as the session goes on.
SlowLaw growing_leak(const Trajectory& over, Random& random) {
  const double fold_c = random.uniform(6.0, 12.0);
  const double top_c = *std::max_element(over.die_c.begin(), over.die_c.end());
  const double end_s = static_cast<double>(over.seconds());
  return outsider("growing_leak", {{"fold_c", fold_c}}, [=](const Trajectory& at, std::size_t i) {
    return static_cast<double>(i) / end_s * std::exp((at.die_c[i] - top_c) / fold_c);
  });
}

/// Somebody opens the door of the room now and then; the air dries over an hour or so.
SlowLaw humidity_bursts(const Trajectory& over, Random& random) {
  const double dry_s = random.uniform(1800.0, 4000.0);
  std::vector<double> opened_s;
  for (double t_s = random.uniform(2000.0, 6000.0); t_s < static_cast<double>(over.seconds());
       t_s += random.uniform(4000.0, 11000.0)) {
    opened_s.push_back(t_s);
  }
  return outsider("humidity_bursts", {{"dry_s", dry_s}}, [=](const Trajectory&, std::size_t i) {
    double wet = 0.0;
    for (double t_s : opened_s) {
      const double since_s = static_cast<double>(i) - t_s;
      if (since_s > 0.0) wet += std::exp(-since_s / dry_s) - std::exp(-since_s / 500.0);
    }
    return wet;
  });
}

SlowLaw sine_in_temperature(Random& random) {
  const double period_c = random.uniform(8.0, 15.0);
  const double phase = random.uniform(0.0, full_turn);
  return outsider("sine_in_temperature", {{"period_c", period_c}},
                  [=](const Trajectory& at, std::size_t i) {
                    return 0.5 * std::sin(full_turn * at.die_c[i] / period_c + phase);
                  });
}

SlowLaw chirp(const Trajectory& over, Random& random) {
  const double end_s = static_cast<double>(over.seconds());
  const double slow_hz = 1.0 / random.uniform(8000.0, 12000.0);
  const double fast_hz = 1.0 / random.uniform(900.0, 1500.0);
  return outsider(
      "chirp", {{"from_hz", slow_hz}, {"to_hz", fast_hz}}, [=](const Trajectory&, std::size_t i) {
        const double t_s = static_cast<double>(i);
        return 0.5 *
               std::sin(full_turn * (slow_hz + 0.5 * (fast_hz - slow_hz) * t_s / end_s) * t_s);
      });
}

SlowLaw sawtooth(Random& random) {
  const double period_s = random.uniform(2400.0, 5400.0);
  const double start = random.uniform(0.0, 1.0);
  return outsider("sawtooth", {{"period_s", period_s}}, [=](const Trajectory&, std::size_t i) {
    const double phase = static_cast<double>(i) / period_s + start;
    return phase - std::floor(phase) - 0.5;
  });
}

SlowLaw rate_squared() {
  return outsider("rate_squared", {}, [](const Trajectory& at, std::size_t i) {
    return at.rate_c_per_min[i] * at.rate_c_per_min[i];
  });
}

SlowLaw pulse_train(Random& random) {
  const double period_s = random.uniform(1500.0, 2700.0);
  const double share = random.uniform(0.15, 0.35);
  return outsider("pulse_train", {{"period_s", period_s}, {"share_on", share}},
                  [=](const Trajectory&, std::size_t i) {
                    const double phase = static_cast<double>(i) / period_s;
                    return phase - std::floor(phase) < share ? 1.0 : 0.0;
                  });
}

}  // namespace

SlowLaw draw_outsider(const std::string& law, const Trajectory& over, Random& random) {
  if (law == "supply_ripple") return supply_ripple(random);
  if (law == "growing_leak") return growing_leak(over, random);
  if (law == "humidity_bursts") return humidity_bursts(over, random);
  if (law == "sine_in_temperature") return sine_in_temperature(random);
  if (law == "chirp") return chirp(over, random);
  if (law == "sawtooth") return sawtooth(random);
  if (law == "rate_squared") return rate_squared();
  if (law == "pulse_train") return pulse_train(random);
  throw std::invalid_argument("no outsider called " + law);
}

}  // namespace hidden
