// gyrocald: one campaign without a person, for systemd. It goes on by itself after a crash; a
// campaign that has tripped, or has ended, it leaves alone.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "daemon/cli/outcome.h"
#include "daemon/runner/progress.h"
#include "daemon/runner/run_request.h"
#include "daemon/runner/service_notifier.h"
#include "daemon/runner/stop_signals.h"
#include "gyrocal_version.h"

namespace {

using namespace gyrocal;

constexpr std::chrono::seconds stopping_takes_up_to{15};
constexpr Duration fresh_reading = std::chrono::seconds{60};

int exit_code(const runner::Outcome& outcome) {
  if (outcome.stopped) return cli::exit_safe_state;
  if (const auto* finished = std::get_if<campaign::Finished>(&outcome.state)) {
    return finished->models ? cli::exit_done : cli::exit_failed;
  }
  return cli::exit_safe_state;
}

int run(runner::RunRequest request) {
  const runner::StopSignals signals;
  runner::Progress log(false);
  runner::ServiceNotifier notifier(fresh_reading);
  runner::RunHooks hooks;
  hooks.log = [&](const EventInsert& event) { log.show(event); };
  hooks.progress = [&](const runner::Snapshot& now) { notifier.show(now); };
  hooks.stop_asked = [&, told = false]() mutable {
    const bool asked = runner::StopSignals::asked();
    if (asked && !told) notifier.stopping(stopping_takes_up_to);
    told = asked;
    return asked;
  };
  const auto outcome = runner::run_requested(request, hooks, [](auto&&...) {});
  if (!outcome) return cli::report(outcome.error());
  fmt::print(stderr, "gyrocald: campaign {}\n", campaign::name(outcome->state));
  if (const auto* safe = std::get_if<campaign::Safe>(&outcome->state)) {
    fmt::print(stderr, "gyrocald: {}\n", safe->why);
  }
  return exit_code(*outcome);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"gyrocald: runs one calibration campaign, and goes on with it after a crash"};
  runner::RunRequest request;
  std::string database;
  app.add_option("campaign", request.campaign_path, "campaign file (TOML)")->required();
  app.add_option("--db", database, "database; default: the campaign file's");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::exit_done : cli::exit_bad_input;
  }
  if (!database.empty()) request.database = database;
  request.resume = true;
  request.unattended = true;
  request.software_version = GYROCAL_VERSION;
  return run(std::move(request));
}
