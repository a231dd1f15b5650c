#include "daemon/cli/plan_file.h"

#include <fmt/core.h>

#include <algorithm>

#include "config/campaign_variant.h"

namespace gyrocal::cli {
namespace {

bool is_wanted(const PlanPair& pair, const std::vector<EffectPair>& wanted) {
  return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const EffectPair& names) {
           return (names.first == pair.effect && names.second == pair.rival) ||
                  (names.first == pair.rival && names.second == pair.effect);
         });
}

std::vector<PlanPair> wanted_pairs(const PlanAddition& addition,
                                   const std::vector<EffectPair>& wanted) {
  std::vector<PlanPair> pairs;
  std::copy_if(addition.separated.begin(), addition.separated.end(), std::back_inserter(pairs),
               [&](const PlanPair& pair) { return is_wanted(pair, wanted); });
  return pairs;
}

}  // namespace

rig::SessionPlan session_plan(const CampaignConfig& config) {
  rig::SessionPlan plan;
  plan.setpoints_c.clear();
  for (const Celsius setpoint : config.plan.setpoints) plan.setpoints_c.push_back(setpoint.value);
  plan.soak_s = config.stability.soak_s_min;
  plan.samples_per_dwell = config.plan.samples_per_setpoint;
  plan.sample_rate_hz = config.plan.sample_rate_hz;
  return plan;
}

Result<std::string> campaign_with_best(const CampaignConfig& config,
                                       const std::vector<PlanAddition>& additions,
                                       const std::vector<EffectPair>& wanted) {
  const auto useful =
      std::find_if(additions.begin(), additions.end(), [&](const PlanAddition& addition) {
        return !addition.plan.power_cycle_before && !wanted_pairs(addition, wanted).empty();
      });
  if (useful == additions.end()) {
    return fail(Errc::bad_input,
                "no addition to this plan separates a pair that it does not separate by itself",
                "`gyrocal plan` prints what would tell each pair apart");
  }
  CampaignVariant variant;
  variant.name = config.name + "_apart";
  variant.reason = fmt::format("{} with one addition: {} ({:+.1f} h). It separates", config.name,
                               useful->what, useful->extra_h);
  for (const PlanPair& pair : wanted_pairs(*useful, wanted)) {
    variant.reason += fmt::format("\n#   {} and {}, from {:.4g} {} on", pair.effect, pair.rival,
                                  pair.apart_from, pair.unit);
  }
  for (const double visit : useful->plan.setpoints_c) variant.visits.push_back({visit});
  if (useful->plan.soak_s != config.stability.soak_s_min) variant.soak_s_min = useful->plan.soak_s;
  return campaign_variant(config, variant);
}

}  // namespace gyrocal::cli
