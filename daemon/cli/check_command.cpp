#include <fmt/core.h>

#include <memory>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/runner/check.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/owned_devices.h"
#include "daemon/runner/run_request.h"

namespace gyrocal::cli {
namespace {

struct CheckOptions {
  std::string campaign;
  std::string database;
  bool as_json = false;
};

int check(const CheckOptions& options) {
  const auto config = read_campaign(options.campaign);
  if (!config) return report(config.error());
  const auto lock = runner::lock_chamber(config->chamber);
  if (!lock) return report(lock.error());
  const auto owned = runner::wired_devices(*config);
  auto devices = owned->devices();
  const auto database = options.database.empty() ? config->database : options.database;
  const auto checked =
      runner::check_campaign(*config, devices, runner::wired_options(*config).patience, database);
  if (!checked) return report(checked.error());
  fmt::print("{}",
             options.as_json ? runner::check_json(*checked) + "\n" : runner::check_text(*checked));
  for (const auto& device : checked->devices) {
    if (!device.found) report(device.found.error());
  }
  return checked->passed() ? exit_done : exit_failed;
}

}  // namespace

void add_check(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand("check",
                                      "Example: gyrocal check config/campaigns/weekend.toml\n"
                                      "Reads chamber and boards and prints plan, limits, duration "
                                      "and disk need. Writes nothing to\n"
                                      "the chamber, nothing to disk.");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("campaign", options->campaign, "campaign file (TOML)")->required();
  command->add_option("--db", options->database, "database; default: the campaign file's");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

}  // namespace gyrocal::cli
