#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compensation/drift/analysis.h"

namespace gyrocal {

/// {"a": 0.0034, ..., "setpoints_c": [-10, ...]}: what the database keeps as parameters_json and
/// evaluate() needs. Keys in the model's order; a list of one value prints as a number.
[[nodiscard]] nlohmann::ordered_json parameters_to_json(
    const std::vector<NamedParameter>& parameters);
/// @return bad_input when a value is neither a number nor a list of numbers.
[[nodiscard]] Result<std::vector<NamedParameter>> parameters_from_json(
    const nlohmann::ordered_json& json);

/// One element of "models" of `gyrocal fit --json` (DESIGN section 7). Unknown numbers are null.
[[nodiscard]] nlohmann::ordered_json model_to_json(const FittedModel& model);
/// Reads "method", "parameters" (checked by building the curve), "measured" and "fitted"; what else
/// model_to_json wrote where it is there.
/// @return bad_input, unknown_name.
[[nodiscard]] Result<FittedModel> model_from_json(const nlohmann::ordered_json& json);

/// {"models": [...], "recommended", "reason", "refused": [{"method", "why"}], "warnings"}.
[[nodiscard]] nlohmann::ordered_json analysis_to_json(const Analysis& analysis);

}  // namespace gyrocal
