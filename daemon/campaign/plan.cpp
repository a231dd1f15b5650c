#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {

Result<Plan> make_plan(const CampaignConfig& config) {
  Plan plan;
  plan.setpoints = config.plan.setpoints;
  plan.allowed = allowed_setpoints(config);
  plan.safe = config.plan.safe_setpoint;
  plan.ramp_per_minute = config.plan.ramp_per_minute;
  plan.heating_per_minute = config.chamber.profile.heating_per_minute;
  plan.cooling_per_minute = config.chamber.profile.cooling_per_minute;
  plan.samples_per_dwell = config.plan.samples_per_setpoint;
  plan.sample_rate_hz = config.plan.sample_rate_hz;
  plan.stability = config.stability;
  plan.limits = config.limits;
  plan.poll_interval = seconds(config.chamber.poll_interval_s);
  for (const auto& board : config.boards) plan.boards.push_back(board.name);
  for (const Celsius setpoint : plan.setpoints) {
    if (auto ok = commandable(plan.allowed, setpoint); !ok) return tl::unexpected(ok.error());
  }
  if (auto ok = commandable(plan.allowed, plan.safe); !ok) return tl::unexpected(ok.error());
  return plan;
}

}  // namespace gyrocal::campaign
