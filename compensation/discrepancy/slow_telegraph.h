#pragma once

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// Two-level switching slow enough to be seen in the slow stream.
struct SlowTelegraph {
  /// Over Gaussian noise of the same spectrum (a walk that forgets), both over the rows [nat].
  double lead_nats = 0;
  double level_dps = 0, level_sd_dps = 0;
  double low_dwell_s = 0, high_dwell_s = 0;
  double flips = 0;  ///< expected number of changes of level
  /// Gain of a gamma law for the lengths of stays over the exponential that chance makes, stays cut
  /// by noise allowed for: large where something switches by a clock [nat]. Of exponential stays
  /// one set in a hundred exceeds 6 a level.
  double regular_nats = 0;
  Eigen::VectorXd high;  ///< probability of the high level, mean over each bin
};

/// Hidden Markov model over the monitor's rows (a bin with a flip inside lies between the levels),
/// the design's coefficients fitted with it, several starts. One flip is a jump, not a telegraph:
/// `flips` tells.
/// @param model  without drift noise of its own.
[[nodiscard]] SlowTelegraph fit_slow_telegraph(const SlowModel& model);

}  // namespace gyrocal
