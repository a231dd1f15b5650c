#pragma once

#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {

/// Three setpoints, two boards, the limits of a campaign file that names none.
inline Plan three_points() {
  Plan plan;
  plan.setpoints = {Celsius{-10}, Celsius{20}, Celsius{50}};
  plan.allowed = {Celsius{-20}, Celsius{70}};
  plan.safe = Celsius{25};
  plan.poll_interval = seconds(5);
  plan.boards = {"left", "right"};
  return plan;
}

}  // namespace gyrocal::campaign
