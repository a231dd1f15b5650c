#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "compensation/discrepancy/coherence.h"
#include "compensation/discrepancy/diagnosis.h"

namespace gyrocal::cli {

/// "gyrocal-diagnosis/1" (DESIGN section 10).
[[nodiscard]] nlohmann::ordered_json to_json(const Diagnosis& diagnosis);

/// "gyrocal-diagnosis-all/1": {"format", "diagnoses": [{"board", "axis", "diagnosis"}], "shared":
/// [{"effect", "origin", "seen_in", "absent_in", "blind_in", "sentence"}]}.
[[nodiscard]] nlohmann::ordered_json to_json(std::span<const AxisDiagnosis> diagnoses,
                                             std::span<const SharedEffect> shared);
[[nodiscard]] std::string to_text(std::span<const AxisDiagnosis> diagnoses,
                                  std::span<const SharedEffect> shared);

/// The same for a person: verdict, findings with their sentences, the gap, the limits.
[[nodiscard]] std::string to_text(const Diagnosis& diagnosis);

}  // namespace gyrocal::cli
