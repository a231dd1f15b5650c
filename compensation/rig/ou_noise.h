#pragma once

#include <span>
#include <vector>

#include "compensation/rig/effects/effect.h"
#include "compensation/rig/random.h"

namespace gyrocal::rig {

/// Generates the sum of independent Ornstein-Uhlenbeck terms, exactly for any step: terms with a
/// finite tau start in their stationary law, random walks at 0.
class OuNoise {
 public:
  OuNoise(std::span<const OuTerm> terms, const StreamKey& key);
  /// Moves on by dt_s >= 0 and returns the sum [deg/s].
  double advance(double dt_s);
  [[nodiscard]] double value_dps() const;

 private:
  struct State {
    OuTerm term;
    double value_dps;
    double kept;      // factor over the prepared step
    double kick_dps;  // standard deviation of what is new in it
  };
  void prepare(double dt_s);

  std::vector<State> states_;
  RandomStream random_;
  double step_s_ = -1.0;
};

}  // namespace gyrocal::rig
