#include <fmt/core.h>

#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/make_safe.h"
#include "daemon/runner/owned_devices.h"

namespace gyrocal::cli {
namespace {

constexpr double tried_for_wall_s =
    50;  ///< the chamber shall be safe a minute after a daemon's death

int make_safe(const std::string& campaign) {
  const auto config = read_campaign(campaign);
  if (!config) return report(config.error());
  const auto lock = runner::lock_chamber(config->chamber);
  if (!lock) return report(lock.error());
  const auto owned = runner::wired_devices(*config);
  auto devices = owned->devices();
  const auto done = runner::make_chamber_safe(*config, devices.chamber, devices.clock,
                                              seconds(tried_for_wall_s * config->time_scale));
  if (!done) return report(done.error());
  fmt::print("chamber {}: setpoint {:.1f} degC, confirmed\n", runner::chamber_name(config->chamber),
             config->plan.safe_setpoint.value);
  return exit_done;
}

}  // namespace

void add_make_safe(CLI::App& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "make-safe",
      "Example: gyrocal make-safe weekend.toml\n"
      "Brings the chamber to the campaign's safe setpoint without a daemon, and waits until it is\n"
      "confirmed, up to 50 s. Refused while a campaign commands the chamber: abort that.");
  const auto campaign = std::make_shared<std::string>();
  command->add_option("campaign", *campaign, "campaign file (TOML)")->required();
  command->callback([campaign, &chosen] { chosen = [campaign] { return make_safe(*campaign); }; });
}

}  // namespace gyrocal::cli
