#pragma once

#include "daemon/runner/campaign_loop.h"

namespace gyrocal::runner {

/// What goes on with a campaign begins so long after the latest row: more than an interval of the
/// slow stream, so that none is begun twice.
inline constexpr Duration apart_from_before = 2 * monitor_interval;

/// The rows a new campaign starts from.
[[nodiscard]] Result<CampaignLoop::Begin> begin_new(const CampaignConfig& config,
                                                    const Found& found, const Clock& clock,
                                                    Store& store,
                                                    const std::string& software_version);

/// Goes on with a campaign that has not ended: accepted dwells stay, the first setpoint that lacks
/// one is next. Campaign time goes on from its start by UTC, and never backwards.
/// @return mismatch if the campaign file has changed or another board stands where one was.
[[nodiscard]] Result<CampaignLoop::Begin> begin_again(const CampaignConfig& config,
                                                      const Found& found, const Clock& clock,
                                                      Store& store, const OpenCampaign& open);

}  // namespace gyrocal::runner
