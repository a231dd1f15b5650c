#pragma once

#include "compensation/drift/identity.h"
#include "config/drift_model/model_json.h"

namespace gyrocal {

/// A model with the sensor it is of.
struct ModelOfSensor {
  SensorIdentity identity;
  FittedModel model;
};

/// {"board", "axis", "temperature_scale"}, null where not stated.
[[nodiscard]] nlohmann::ordered_json identity_to_json(const SensorIdentity& identity);

/// Takes one model out of what `gyrocal fit --json` printed ({"models": [...], "sensor": {...}}),
/// or of a file that holds one such model by itself.
/// @param text    JSON.
/// @param source  for messages: the path.
/// @param method  the wanted one; empty: the recommended one, or the only one.
/// @return bad_input, naming source (and line where the JSON breaks), or unknown_name with the
///         methods the file has.
[[nodiscard]] Result<ModelOfSensor> model_from_text(const std::string& text,
                                                    const std::string& source,
                                                    const std::string& method);

}  // namespace gyrocal
