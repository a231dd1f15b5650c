#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "compensation/rig/rig_model.h"
#include "daemon/runner/campaign_runner.h"

namespace gyrocal::runner {

/// What stands for chamber and boards.
struct VirtualRig {
  std::uint64_t seed = 1;
  rig::RigModel model;
};

/// What somebody asks for who wants a campaign run.
struct RunRequest {
  std::string campaign_path;
  std::optional<std::string> database;  ///< instead of the campaign file's
  bool resume = false;                  ///< go on with what the database holds
  bool unattended = false;  ///< leave a campaign alone that has ended, or tripped: no person asks
  std::optional<VirtualRig> virtual_rig;  ///< in process, in virtual time
  std::optional<bool> record;             ///< into NAME.recording.db; default: on real endpoints
  std::string software_version;
};

/// Reads the campaign file, opens database and devices, runs the campaign.
/// @param report  called with the database before it is closed, when the campaign has finished.
/// @return how it ended; bad_input if virtual time is asked of a campaign whose devices are not
///   simulated; what reading, store and run_campaign() return.
[[nodiscard]] Result<Outcome> run_requested(
    const RunRequest& request, const RunHooks& hooks,
    const std::function<void(const Store&, CampaignId, const std::string& database)>& report);

/// Settings of the loop for a campaign on real endpoints, and for one in virtual time.
[[nodiscard]] RunOptions wired_options(const CampaignConfig& config);
[[nodiscard]] RunOptions virtual_options(const CampaignConfig& config);

}  // namespace gyrocal::runner
