#pragma once

#include "config/campaign.h"
#include "drivers/chamber/chamber.h"
#include "drivers/clock.h"

namespace gyrocal::runner {

/// Brings a chamber to the campaign's safe setpoint without a campaign: what is left to do when the
/// daemon is dead. Tries until the chamber confirms it. A chamber that stands still is not started.
/// @param within  campaign time to try for.
/// @return busy if a program of the chamber's own runs: somebody else's; else the last error.
[[nodiscard]] Result<void> make_chamber_safe(const CampaignConfig& config, Chamber& chamber,
                                             Clock& clock, Duration within);

}  // namespace gyrocal::runner
