#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// How far a campaign is cut out of a database.
struct CampaignSlice {
  CampaignId campaign{};
  /// Rows of a later campaign time are left out, and with them every analysis.
  std::int64_t t_last_ns = std::numeric_limits<std::int64_t>::max();
  std::optional<std::string> state{};        ///< that it had then; absent: as it stands
  std::optional<std::string> config_toml{};  ///< instead of the campaign file it was begun with
};

/// Writes one campaign, as it stood at a time, into a database of its own. Every row keeps its id.
/// Diagnoses and rig models are left out. For a campaign goes on later than it stopped, one time
/// parts what an earlier run stored from what a later one did.
/// @return busy: `target` exists; unknown_name: no such campaign; what reading and writing return.
[[nodiscard]] Result<void> cut_out_campaign(const std::string& source, const std::string& target,
                                            const CampaignSlice& slice);

}  // namespace gyrocal
