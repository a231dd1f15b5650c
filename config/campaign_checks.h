#pragma once

#include "config/campaign.h"
#include "config/campaign_sections.h"

namespace gyrocal {

/// Notes what no single value shows: setpoints outside what boards and chamber may see, two boards
/// on one device, waits that contradict each other, a time scale on real devices. For a campaign
/// whose single values are sound; its setpoints as listed.
void check_together(CampaignSections& sections, const CampaignConfig& campaign);

}  // namespace gyrocal
