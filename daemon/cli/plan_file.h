#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compensation/experiment/plan_additions.h"
#include "config/campaign.h"

namespace gyrocal::cli {

/// A campaign's plan as the simulation knows it: visits as listed, the least soak.
[[nodiscard]] rig::SessionPlan session_plan(const CampaignConfig& config);

/// The names of two effects that are to be told apart.
using EffectPair = std::pair<std::string, std::string>;

/// The campaign with the addition that separates most pairs for its hours, as TOML. A power cycle
/// is a person's hand and is not written.
/// @param wanted  the pairs that count; none: all.
/// @return bad_input if no addition separates any.
[[nodiscard]] Result<std::string> campaign_with_best(const CampaignConfig& config,
                                                     const std::vector<PlanAddition>& additions,
                                                     const std::vector<EffectPair>& wanted);

}  // namespace gyrocal::cli
