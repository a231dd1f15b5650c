#pragma once

#include <span>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/dwell_codes.h"
#include "compensation/discrepancy/slow_story.h"
#include "compensation/rig/effects/effect.h"

namespace gyrocal {

/// Gives the slow model what the rig model already holds for this axis: deterministic effects and
/// empirical terms as a known course, drift noise as its family.
/// @return what the known course gains over the same noise without it [nat].
double give_known_effects(std::span<const rig::Instance> instances, const rig::RigModel& model,
                          std::size_t axis, SlowModel& slow);

/// Puts the first `count` findings into a model that has none of them.
void add_findings(SlowModel& slow, const std::vector<SlowFinding>& story, std::size_t count);

/// Whether the rig model already holds this effect with about this amplitude: within four standard
/// errors or a quarter; for a finding in the samples without a name, such a term.
[[nodiscard]] bool already_modelled(const Finding& finding,
                                    std::span<const rig::Instance> instances,
                                    std::span<const rig::EmpiricalTerm> unexplained);

/// The part of a rig model that acts on samples, codes and link; its slow drifts left out.
[[nodiscard]] rig::RigModel fast_part(const rig::RigModel& model);

/// Adds a finding of the catalogue to a rig model, for one axis.
void add_effect(rig::RigModel& model, const Finding& finding, std::size_t axis);

/// The given model with this session's bias, noise and lags as baseline and all findings added.
/// @param story  of the slow stream: whose courses without a name are kept.
/// @param findings  of all channels, settled between them.
[[nodiscard]] rig::RigModel updated_model(const rig::RigModel& given, const SlowModel& slow,
                                          const std::vector<SlowFinding>& story,
                                          const std::vector<Finding>& findings,
                                          const CodeFindings& codes, std::size_t axis);

}  // namespace gyrocal
