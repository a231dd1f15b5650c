#pragma once

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// Drift with a time scale of its own: white noise through a second-order resonance,
///   x'' + (w0/Q) x' + w0^2 x = n.
/// Overdamped it is a walk that forgets, underdamped it wanders about a period; neither flicker nor
/// a random walk has a scale, so what this explains better is none of the two.
struct ResonantDrift {
  double log_likelihood = -1e300;  ///< of design + resonance + white noise, all fitted [nat]
  double period_s = 0;             ///< 2 pi / w0
  double quality = 0;              ///< Q
  double sd_dps = 0;               ///< of x
  double turns = 0;                ///< periods in the record
};

/// Exact likelihood by a Kalman filter over the bins, several starts. Coefficients and white level
/// are profiled out.
[[nodiscard]] ResonantDrift fit_resonant_drift(const SlowModel& model);

}  // namespace gyrocal
