#pragma once

#include <string>

#include "daemon/report/campaign_figures.h"

namespace gyrocal::report {

/// A campaign as one HTML file: conditions, verdict per axis, temperatures, dwells, drift with all
/// models, comparison, Allan deviation, residuals, rejected dwells, troubles, diagnoses,
/// provenance. A campaign that runs, failed or holds nothing yet is told as far as it got.
/// @return the errors of svg_of().
[[nodiscard]] Result<std::string> campaign_report(const CampaignFacts& facts,
                                                  const std::string& software_version);

}  // namespace gyrocal::report
