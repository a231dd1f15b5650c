#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/runner/after_trip.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/make_safe.h"
#include "daemon/runner/owned_devices.h"

namespace gyrocal::cli {
namespace {

constexpr double tried_for_wall_s =
    50;  ///< the chamber shall be safe a minute after a daemon's death

struct MakeSafeOptions {
  std::string campaign;
  std::string database;
};

/// The daemon that wrote `database` took its hands off the chamber.
Result<bool> hands_off(const std::string& database) {
  if (database.empty() || !std::filesystem::exists(database)) return false;
  const auto store = Store::open_read_only(database);
  if (!store) return tl::unexpected(store.error());
  const auto campaign = store->latest_campaign();
  if (!campaign) return tl::unexpected(campaign.error());
  if (!*campaign) return false;
  const auto left = runner::after_trip(*store, **campaign);
  if (!left) return tl::unexpected(left.error());
  return *left == runner::AfterTrip::hands_off;
}

int make_safe(const MakeSafeOptions& options) {
  const auto config = read_campaign(options.campaign);
  if (!config) return report(config.error());
  const auto off = hands_off(options.database);
  if (!off) report(off.error());  // a database that cannot be read is no reason to leave it cold
  if (off.value_or(false)) {
    fmt::print(stderr,
               "gyrocal: somebody else commands the chamber (event hands_off in {}); "
               "nothing was written\n",
               options.database);
    return exit_done;
  }
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

void add_make_safe(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "make-safe",
      "Example: gyrocal make-safe weekend.toml\n"
      "Brings the chamber to the campaign's safe setpoint without a daemon, and waits until it is\n"
      "confirmed, up to 50 s. Refused while a campaign commands the chamber: abort that.");
  const auto options = std::make_shared<MakeSafeOptions>();
  command->add_option("campaign", options->campaign, "campaign file (TOML)")->required();
  command->add_option("--db", options->database,
                      "of the daemon that ended: if it took its hands off the chamber because "
                      "somebody else commands it, nothing is written");
  command->callback([options, &chosen] { chosen = [options] { return make_safe(*options); }; });
}

}  // namespace gyrocal::cli
