#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/slow_story.h"
#include "compensation/discrepancy/track.h"

namespace gyrocal {

/// The slow stream's findings in the catalogue's words and units.
[[nodiscard]] std::vector<Finding> to_findings(const std::vector<SlowFinding>& story);

/// The board's temperature sensor, if it is off by more than its own rounding could be.
[[nodiscard]] std::optional<Finding> sensor_finding(const BoardSensorFit& fit);
void add_sensor_limit(const BoardSensorFit& fit, std::map<std::string, double>& limits);

/// Fills descriptions, and what would tell rivals apart, from the catalogue.
void explain(std::vector<Finding>& findings);

/// unexplained before confounded before explained: the weakest finding decides.
[[nodiscard]] Verdict verdict_of(const std::vector<Finding>& findings);

}  // namespace gyrocal
