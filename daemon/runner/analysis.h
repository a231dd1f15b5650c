#pragma once

#include <span>
#include <string>
#include <vector>

#include "compensation/drift/model.h"
#include "compensation/wavelet/denoise.h"
#include "config/campaign.h"
#include "schema/store.h"

namespace gyrocal::runner {

/// The filter a campaign file names. @return unknown_name with the list of known names.
[[nodiscard]] Result<DenoiseSettings> denoise_settings(const AnalysisConfig& config);

/// Raw counts of one axis as rates [deg/s]. The scale factor is taken at the board's temperature:
/// of the sample, else of the dwell, else 20 degC (as view sample_dps does).
[[nodiscard]] std::vector<double> rates_dps(std::span<const BoardSample> samples, Axis axis,
                                            const BoardRow& board, double dwell_board_c);

/// A model as the store takes it, without provenance and not recommended.
[[nodiscard]] ModelInsert model_row(const FittedModel& model, BoardId board, Axis axis);

/// From accepted dwells to stored models, for every board and axis: raw counts to deg/s, wavelet
/// filter per dwell, its mean as zero drift, models over the setpoints, with the dwells used, the
/// hash of their samples, the settings and the version beside them. The same database content gives
/// the same models to the last bit. All is stored in one transaction.
/// @return too_few_points if no board has the dwells a model needs; what the store returns.
[[nodiscard]] Result<void> analyse_campaign(Store& store, CampaignId campaign,
                                            const CampaignConfig& config,
                                            const std::string& software_version);

}  // namespace gyrocal::runner
