#pragma once

#include <string>
#include <vector>

#include "daemon/status/facts.h"
#include "daemon/status/history.h"
#include "drivers/clock.h"
#include "schema/store.h"

namespace gyrocal::status {

/// What a campaign's database holds of its time before `t`: what an earlier run of the daemon saw.
struct Past {
  std::vector<EventInsert> events;
  std::vector<Point> history;  ///< slopes are not kept in the database
};

/// Reads beside the campaign that writes. @return what Store returns.
[[nodiscard]] Result<Past> read_past(const Facts& facts, CampaignId campaign, Duration t);

}  // namespace gyrocal::status
