#pragma once

#include <map>
#include <string>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// Smallest amplitude at which each slow effect, at its usual shape, would be expected to pass the
/// gate. Whoever looks for it fits the noise again, and flicker or a walk can stand in for part of
/// any drift: the amplitude is the one whose expected gain is the gate whatever noise is tried,
///   min over noise of (cost of that noise where there is none + a^2 |x|^2 / 2) = gate,
/// x the effect's column, whitened by that noise, what the design can make taken off.
/// Effects whose trace the design makes by itself are absent.
/// Source: discrepancy_methods.md sections 2 and 4 (trap 4).
[[nodiscard]] std::map<std::string, double> slow_limits(const SlowModel& model);

}  // namespace gyrocal
