#pragma once

#include <string>
#include <vector>

#include "compensation/experiment/plan_power.h"

namespace gyrocal {

/// One thing that could be added to a plan, and what it would buy.
struct PlanAddition {
  std::string what;       ///< "4 revisits", as a person would say it
  rig::SessionPlan plan;  ///< the plan with it; its visits listed, sweep `up`
  double extra_h = 0;
  std::vector<PlanPair> separated;  ///< pairs it tells apart that the plan does not, as they become
};

/// Revisits of four temperatures, going back down, a soak three times as long, a power cycle half
/// way with a revisit: each alone, judged against the plan itself, `present`. Those that separate
/// most pairs for their hours come first; those that separate none come last.
/// @return errors of plan_contrast().
[[nodiscard]] Result<std::vector<PlanAddition>> plan_additions(const rig::SessionPlan& plan,
                                                               const rig::RigModel& model,
                                                               Axis axis,
                                                               const PlanContrast& present);

}  // namespace gyrocal
