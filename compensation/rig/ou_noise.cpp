#include "compensation/rig/ou_noise.h"

#include <cmath>

#include "compensation/rig/portable_math.h"

namespace gyrocal::rig {

OuNoise::OuNoise(std::span<const OuTerm> terms, const StreamKey& key) : random_(key) {
  for (const OuTerm& term : terms) {
    const bool walk = std::isinf(term.tau_s);
    const double start = walk ? 0.0 : std::sqrt(term.variance_dps2) * random_.normal();
    states_.push_back({term, start, 1.0, 0.0});
  }
}

void OuNoise::prepare(double dt_s) {
  step_s_ = dt_s;
  for (State& s : states_) {
    if (std::isinf(s.term.tau_s)) {
      s.kick_dps = std::sqrt(s.term.walk_dps2_per_s * dt_s);
    } else {
      s.kept = portable_exp(-dt_s / s.term.tau_s);
      s.kick_dps = std::sqrt(s.term.variance_dps2 * (1.0 - s.kept * s.kept));
    }
  }
}

double OuNoise::advance(double dt_s) {
  if (dt_s != step_s_) prepare(dt_s);
  for (State& s : states_) s.value_dps = s.value_dps * s.kept + s.kick_dps * random_.normal();
  return value_dps();
}

double OuNoise::value_dps() const {
  double sum = 0.0;
  for (const State& s : states_) sum += s.value_dps;
  return sum;
}

}  // namespace gyrocal::rig
