#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compensation/discrepancy/diagnosis.h"

namespace gyrocal::cli {

/// "gyrocal-diagnosis/1" (DESIGN section 10).
[[nodiscard]] nlohmann::ordered_json to_json(const Diagnosis& diagnosis);

/// The same for a person: verdict, findings with their sentences, the gap, the limits.
[[nodiscard]] std::string to_text(const Diagnosis& diagnosis);

}  // namespace gyrocal::cli
