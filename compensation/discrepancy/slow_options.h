#pragma once

#include <string>
#include <vector>

#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {

/// What each shape parameter of a law or a noise must gain before it counts.
inline constexpr double parameter_costs_nats = 1;

/// One thing that could be added to the model next, whatever its kind, on one scale.
struct SlowOption {
  SlowFinding finding;
  /// Log likelihood over the present model's with nothing else added, its own shape parameters
  /// paid for [nat]. Drift and noise that imitates it compete on this number.
  double score = 0;
  /// What it gains that no noise could: over the present model with all noise free [nat]. Equal to
  /// the score for noise itself.
  double beyond_noise = 0;
  NoiseFamily noise;           ///< stochastic ones: what joins the family
  Eigen::VectorXd known_bins;  ///< telegraph: its level in each bin; else empty
};

/// Everything the catalogue offers for the slow stream, best first.
[[nodiscard]] std::vector<SlowOption> slow_options(const SlowModel& model, double sample_rate_hz,
                                                   const std::vector<std::string>& excluded,
                                                   const Executor& run_all);

}  // namespace gyrocal
