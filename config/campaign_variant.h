#pragma once

#include <string>
#include <vector>

#include "config/campaign.h"

namespace gyrocal {

/// What another campaign does differently from one that is at hand.
struct CampaignVariant {
  std::string name;             ///< of the new campaign
  std::string reason;           ///< for the file's head; later lines begin with #
  std::vector<Celsius> visits;  ///< every setpoint in the order of visit
  double soak_s_min = 0;        ///< 0: as it was
};

/// The campaign's file with other visits and soak, as TOML; its comments are lost, its other
/// settings stay. The database is the new name's default.
/// @return bad_input when the text is no campaign file or the variant makes none.
[[nodiscard]] Result<std::string> campaign_variant(const CampaignConfig& campaign,
                                                   const CampaignVariant& variant);

}  // namespace gyrocal
