#pragma once

#include <string>
#include <vector>

#include "compensation/rig/rig_model.h"

namespace gyrocal {

/// One thing in which two rig models differ. Empty `before`: added; empty `after`: removed.
struct RigModelChange {
  std::string where;  ///< "baseline.noise_dps", "effect thermal_hysteresis: h"
  std::string before;
  std::string after;
  bool operator==(const RigModelChange&) const = default;
};

/// What has to be changed to get from one model to the other, in file order: baseline, effects,
/// unexplained terms. Names and parents are not compared. Effects are paired by name, the first of
/// a name with the first.
[[nodiscard]] std::vector<RigModelChange> rig_model_changes(const rig::RigModel& from,
                                                            const rig::RigModel& to);

/// "h = 0.02 dps, w = 2.5 degC", of a completed effect; with " on x, z" and " of board 1" where it
/// is not everybody's.
[[nodiscard]] std::string effect_values(const rig::EffectUse& use);

}  // namespace gyrocal
