#pragma once

#include <string>
#include <vector>

#include "compensation/rig/rig_model.h"
#include "compensation/rig/session_plan.h"
#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// Of the shuffle and the simulation that stand for a plan: the same plan is judged the same.
inline constexpr std::uint64_t plan_seed = 1;

/// An effect that this plan would show.
struct PlanLimit {
  std::string effect;
  std::string unit;
  double limit = 0;  ///< smallest amplitude that gains 10 nats
};

/// Two effects whose traces this plan makes alike.
struct PlanPair {
  std::string effect;
  std::string rival;
  std::string unit;  ///< of `effect`
  /// Share of the effect's trace that no shape of the rival can make, noise and bias curve taken
  /// off: 1 - rho^2. 1: nothing in common, 0: the same.
  double share_left = 1;
  double apart_from = 0;   ///< amplitude from which the effect leads the rival by 5 nats
  std::string tell_apart;  ///< the observation that would
};

/// How well a plan tells drifts apart, and for how long a campaign.
struct PlanContrast {
  double duration_h = 0;
  std::vector<PlanPair> pairs;  ///< every pair of drifts, most alike first
};

/// What a campaign with this plan could show of one axis of one board.
struct PlanPower : PlanContrast {
  int dwells = 0;
  std::vector<PlanLimit> limits;            ///< in the catalogue's order
  std::vector<std::string> not_observable;  ///< effects this plan cannot show at all
};

/// A pair counts as told apart if at the effect's own detection limit the names are at most this
/// factor in amplitude away: lead 5 nats at twice the limit of 10 nats.
inline constexpr double told_apart_factor = 2;
[[nodiscard]] bool is_told_apart(const PlanPair& pair);

/// Simulates the plan on the rig model and measures, in the whitened slow stream with the cubic
/// bias projected out, how long each effect's trace is and how much of it each other effect can
/// make with any of its laws and shapes: predicted lead = amplitude^2 |trace|^2 (1 - rho^2) / 2.
/// Source: discrepancy_methods.md section 2, step 8.
/// @return errors of the plan, of the rig model, and too_few_points for a plan too short to judge.
[[nodiscard]] Result<PlanContrast> plan_contrast(const rig::SessionPlan& plan,
                                                 const rig::RigModel& model, Axis axis);

/// That, and the detection limits of a diagnosis of the same simulated session.
[[nodiscard]] Result<PlanPower> plan_power(const rig::SessionPlan& plan, const rig::RigModel& model,
                                           Axis axis);

}  // namespace gyrocal
