#include "daemon/status/facts.h"

namespace gyrocal::status {

Facts facts_of(const CampaignConfig& config, const std::string& campaign_path,
               const std::string& database, const std::string& software_version) {
  Facts facts;
  facts.campaign = config.name;
  facts.campaign_path = campaign_path;
  facts.database = database;
  facts.software_version = software_version;
  facts.simulated = config.simulated;
  facts.time_scale = config.time_scale;
  for (const Celsius setpoint : config.plan.setpoints) facts.setpoints_c.push_back(setpoint.value);
  facts.slope_limit_k_per_h = config.stability.board_slope_k_per_h;
  facts.frames_lost_share_max = config.limits.frames_lost_share_max;
  facts.chamber_stale_s = config.limits.chamber_stale_s;
  facts.soak_s_max = config.stability.soak_s_max;
  for (const BoardConfig& board : config.boards) {
    Facts::Board one{board.name, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      one.scale[axis] = {board.lsb_per_dps[axis], board.lsb_per_dps_per_k[axis]};
    }
    facts.boards.push_back(one);
  }
  return facts;
}

}  // namespace gyrocal::status
