#pragma once

#include <array>
#include <string>
#include <vector>

#include "compensation/values/scale_factor.h"
#include "config/campaign.h"

namespace gyrocal::status {

/// What of a campaign does not change while it runs.
struct Facts {
  struct Board {
    std::string name;
    std::array<ScaleFactor, 3> scale;  ///< X, Y, Z
  };
  std::string campaign;
  std::string campaign_path;
  std::string database;
  std::string software_version;
  bool simulated = false;
  double time_scale = 1;            ///< seconds of campaign time in one of the machine's
  std::vector<double> setpoints_c;  ///< in the order of visit
  double slope_limit_k_per_h = 0;
  double frames_lost_share_max = 0;
  double chamber_stale_s = 0;
  double soak_s_max = 0;
  std::vector<Board> boards;
};

[[nodiscard]] Facts facts_of(const CampaignConfig& config, const std::string& campaign_path,
                             const std::string& database, const std::string& software_version);

}  // namespace gyrocal::status
