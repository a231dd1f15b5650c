#pragma once

#include <string>
#include <vector>

#include "compensation/rig/rig_model.h"
#include "compensation/values/error.h"

namespace gyrocal {

/// A rig model as a JSON file, "gyrocal-rig-model/1":
///
///   {"format": "gyrocal-rig-model/1", "name": "default", "parent": "", "parent_hash": "",
///    "baseline": {"chamber": {"heating_c_per_min": 1.0, ...}, "bias_dps": {"x": [c0, c1, c2, c3],
///                 "y": [...], "z": [...]}, "noise_dps": 1.31, ...},
///    "effects": [{"effect": "thermal_hysteresis", "law": "play", "parameters": {"h": 0.02},
///                 "axes": "xyz", "boards": [0]}],
///    "unexplained": [{"driver": "die_c", "at": [...], "dps": [...], "axes": "z"}]}
/// An unexplained term of the noise has "noise_factor" in place of "dps".
///
/// Whatever a baseline leaves out has the default of rig::Baseline; effects may leave out law (the
/// usual one), parameters, axes (all) and boards (all). Names that are not known are refused.

/// The shipped model's name, understood by read_rig_model besides paths.
inline constexpr char default_rig_model[] = "default";

/// Reads a file, or a shipped model by its name (the names in config/rig_models).
/// @return bad_input (also: no such file), unknown_name, out_of_range or not_finite; `what` starts
/// with
///   "FILE:LINE: /effects/0/parameters/w:".
[[nodiscard]] Result<rig::RigModel> read_rig_model(const std::string& path_or_name);

/// Same, from text; `path` only names it in messages.
[[nodiscard]] Result<rig::RigModel> parse_rig_model(const std::string& text,
                                                    const std::string& path);

/// The whole model, every number such that it reads back to the same bits, two spaces a level.
[[nodiscard]] std::string rig_model_to_json(const rig::RigModel& model);

/// 16 hexadecimal digits over baseline, effects and unexplained terms (FNV-1a of their JSON), not
/// over names: two models that simulate alike have the same hash.
[[nodiscard]] std::string rig_model_hash(const rig::RigModel& model);

/// Folders with shipped models, in the order they are searched.
[[nodiscard]] std::vector<std::string> rig_model_folders();

}  // namespace gyrocal
