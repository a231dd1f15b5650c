#include "compensation/experiment/plan_additions.h"

#include <algorithm>

namespace gyrocal {
namespace {

rig::SessionPlan as_listed(const rig::SessionPlan& plan) {
  rig::SessionPlan listed = plan;
  listed.setpoints_c = rig::visits_c(plan, plan_seed);
  listed.revisits_c.clear();
  listed.sweep = rig::Sweep::up;
  return listed;
}

/// Four temperatures from low and high by turns, none of them the last one visited.
std::vector<double> revisits_for(const std::vector<double>& visits_c) {
  std::vector<double> sorted = visits_c;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  return {at(0.2), at(0.7), at(0.4), at(0.9)};
}

std::vector<PlanAddition> candidates(const rig::SessionPlan& plan) {
  const rig::SessionPlan listed = as_listed(plan);
  std::vector<PlanAddition> all;
  const auto add = [&](const char* what, rig::SessionPlan changed) {
    all.push_back({what, std::move(changed), 0, {}});
  };
  rig::SessionPlan revisits = listed;
  for (const double c : revisits_for(listed.setpoints_c)) revisits.setpoints_c.push_back(c);
  add("revisit four temperatures", std::move(revisits));

  rig::SessionPlan back = listed;
  back.setpoints_c.insert(back.setpoints_c.end(), listed.setpoints_c.rbegin() + 1,
                          listed.setpoints_c.rend());
  add("go back through the same setpoints", std::move(back));

  rig::SessionPlan soak = listed;
  soak.soak_s *= 3;
  add("soak three times as long", std::move(soak));

  rig::SessionPlan power = listed;
  const auto half = static_cast<int>(listed.setpoints_c.size() / 2);
  if (!power.power_cycle_before && half > 0) {
    power.power_cycle_before = half;
    add("cycle the boards' power half way", std::move(power));
  }
  return all;
}

bool is_pair(const PlanPair& a, const PlanPair& b) {
  return (a.effect == b.effect && a.rival == b.rival) ||
         (a.effect == b.rival && a.rival == b.effect);
}

std::vector<PlanPair> newly_separated(const PlanContrast& before, const PlanContrast& after) {
  std::vector<PlanPair> separated;
  for (const PlanPair& now : after.pairs) {
    if (!is_told_apart(now)) continue;
    const bool was_open =
        std::any_of(before.pairs.begin(), before.pairs.end(),
                    [&](const PlanPair& old) { return is_pair(old, now) && !is_told_apart(old); });
    if (was_open) separated.push_back(now);
  }
  return separated;
}

}  // namespace

Result<std::vector<PlanAddition>> plan_additions(const rig::SessionPlan& plan,
                                                 const rig::RigModel& model, Axis axis,
                                                 const PlanContrast& present) {
  std::vector<PlanAddition> additions = candidates(plan);
  for (PlanAddition& addition : additions) {
    const auto with_it = plan_contrast(addition.plan, model, axis);
    if (!with_it) return tl::unexpected(with_it.error());
    addition.extra_h = with_it->duration_h - present.duration_h;
    addition.separated = newly_separated(present, *with_it);
  }
  const auto worth = [](const PlanAddition& addition) {
    return static_cast<double>(addition.separated.size()) / (1 + std::max(0.0, addition.extra_h));
  };
  std::stable_sort(
      additions.begin(), additions.end(),
      [&](const PlanAddition& a, const PlanAddition& b) { return worth(a) > worth(b); });
  return additions;
}

}  // namespace gyrocal
