#include <fmt/core.h>
#include <unistd.h>

#include <memory>

#include "config/rig_model.h"
#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/runner/model_table.h"
#include "daemon/runner/progress.h"
#include "daemon/runner/run_request.h"
#include "daemon/runner/stop_signals.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {
namespace {

struct RunArguments {
  std::string campaign;
  std::string database;
  bool resume = false;
  bool in_virtual_time = false;
  std::optional<bool> record;
  std::uint64_t seed = 1;
  std::string rig_model = default_rig_model;
};

void print_models(const Store& store, CampaignId campaign, const std::string& database) {
  const auto table = runner::model_table(store, campaign);
  if (!table) {
    report(table.error());
    return;
  }
  fmt::print("{}\nStored in {}, campaign {}.\n", *table, database,
             static_cast<std::int64_t>(campaign));
}

int exit_code(const runner::Outcome& outcome) {
  if (outcome.stopped) return exit_safe_state;
  if (const auto* finished = std::get_if<campaign::Finished>(&outcome.state)) {
    return finished->models ? exit_done : exit_failed;
  }
  return exit_safe_state;
}

int run(const RunArguments& options) {
  runner::RunRequest request;
  request.campaign_path = options.campaign;
  if (!options.database.empty()) request.database = options.database;
  request.resume = options.resume;
  if (options.in_virtual_time) {
    const auto model = read_rig_model(options.rig_model);
    if (!model) return report(model.error());
    request.virtual_rig = {options.seed, *model};
  }
  request.record = options.record;
  request.software_version = GYROCAL_VERSION;

  const runner::StopSignals signals;
  runner::Progress progress(::isatty(STDERR_FILENO) != 0);
  runner::RunHooks hooks;
  hooks.stop_asked = runner::StopSignals::asked;
  hooks.progress = [&](const runner::Snapshot& now) { progress.show(now); };
  hooks.log = [&](const EventInsert& event) { progress.show(event); };
  const auto outcome = runner::run_requested(request, hooks, print_models);
  if (!outcome) return report(outcome.error());
  if (const auto* safe = std::get_if<campaign::Safe>(&outcome->state)) {
    fmt::print(stderr, "gyrocal: ended in its safe state: {}\n", safe->why);
  }
  return exit_code(*outcome);
}

}  // namespace

void add_run(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "run",
      "Examples: gyrocal run weekend.toml    gyrocal run weekend.toml --resume\n"
      "          gyrocal run config/campaigns/demo.toml --virtual --seed 7 --db demo.db\n"
      "          gyrocal run config/campaigns/demo.toml --virtual --rig-model found.json\n"
      "Runs a campaign to its stored models, with progress and time left. Ctrl-C brings the "
      "chamber\n"
      "to its safe setpoint and ends; --resume goes on. Exit: 0 finished, 1 failed, 2 usage or\n"
      "campaign file, 3 ended in its safe state, stopped or aborted.");
  const auto options = std::make_shared<RunArguments>();
  command->add_option("campaign", options->campaign, "campaign file (TOML)")->required();
  command->add_option("--db", options->database, "database; default: the campaign file's");
  command->add_flag("--resume", options->resume,
                    "go on with a campaign that has not ended; re-arms one that has tripped");
  auto* in_virtual_time = command->add_flag(
      "--virtual", options->in_virtual_time,
      "simulated devices in process, in virtual time: hours in a second, the same every time");
  command->add_option("--seed", options->seed, "of the simulated noise")
      ->needs(in_virtual_time)
      ->capture_default_str();
  command->add_option("--rig-model", options->rig_model, "file, or name of a shipped one")
      ->needs(in_virtual_time)
      ->capture_default_str();
  command->add_flag("--record,!--no-record", options->record,
                    "every byte of every link into NAME.recording.db beside the database, for\n"
                    "gyrocal replay; default: on real endpoints, not with --virtual");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gyrocal::cli
