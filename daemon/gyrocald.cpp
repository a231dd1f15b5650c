// gyrocald: one campaign without a person, for systemd. It goes on by itself after a crash; a
// campaign that has tripped, or has ended, it leaves alone.
#include <fmt/core.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "config/daemon_settings.h"
#include "daemon/cli/command_line.h"
#include "daemon/cli/outcome.h"
#include "daemon/notify/notifier.h"
#include "daemon/runner/progress.h"
#include "daemon/runner/run_request.h"
#include "daemon/runner/service_notifier.h"
#include "daemon/runner/stop_signals.h"
#include "daemon/status/status_page.h"
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

/// Whole lines to stderr, which the unit gives to the journal: page, hooks and broker have threads.
void log_to_stderr() {
  auto logger = spdlog::stderr_logger_mt("gyrocald");
  logger->set_pattern("%n: %l: %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

/// Named, or beside the campaign file, or the defaults.
Result<DaemonSettings> settings_of(const std::string& named, const std::string& campaign_path) {
  if (!named.empty()) return read_daemon_settings(named);
  const auto beside = std::filesystem::path(campaign_path).parent_path() / daemon_settings_name;
  std::error_code none;
  if (!std::filesystem::exists(beside, none)) return DaemonSettings{};
  return read_daemon_settings(beside.string());
}

std::unique_ptr<status::StatusPage> page_of(const StatusSettings& settings, status::Facts facts) {
  if (!settings.on) return nullptr;
  auto page = status::StatusPage::start(settings, std::move(facts));
  if (!page) {
    spdlog::warn("no status page: {}", to_text(page.error()));
    return nullptr;
  }
  spdlog::info("status page at http://{}:{}/", settings.address, settings.port);
  return std::move(*page);
}

int run(runner::RunRequest request, const DaemonSettings& settings) {
  const auto config = read_campaign(request.campaign_path);
  if (!config) return cli::report(config.error());
  const runner::StopSignals signals;
  runner::Progress log(false);
  runner::ServiceNotifier notifier(fresh_reading);
  const auto facts =
      status::facts_of(*config, request.campaign_path, request.database.value_or(config->database),
                       request.software_version);
  const auto page = page_of(settings.status, facts);
  const auto messages = notify::Notifier::start(settings, facts);
  runner::RunHooks hooks;
  hooks.log = [&](const EventInsert& event) {
    log.show(event);
    if (page) page->mailbox().put(event);
    if (messages) messages->mailbox().put(event);
  };
  hooks.progress = [&](const runner::Snapshot& now) {
    notifier.show(now);
    if (page) page->mailbox().put(now);
    if (messages) messages->mailbox().put(now);
  };
  hooks.begun = [&](CampaignId campaign, Duration t) {
    if (page) page->begun(campaign, t);
  };
  hooks.stop_asked = [&, told = false]() mutable {
    const bool asked = runner::StopSignals::asked();
    if (asked && !told) notifier.stopping(stopping_takes_up_to);
    told = asked;
    return asked;
  };
  const auto outcome = runner::run_requested(request, hooks, [](auto&&...) {});
  if (!outcome) return cli::report(outcome.error());
  spdlog::info("campaign {}", campaign::name(outcome->state));
  if (const auto* safe = std::get_if<campaign::Safe>(&outcome->state)) {
    spdlog::warn("{}", safe->why);
  }
  return exit_code(*outcome);
}

}  // namespace

int main(int argc, char** argv) {
  cli::Command app{"gyrocald: runs one calibration campaign, and goes on with it after a crash",
                   "gyrocald"};
  app.add_version_flag("gyrocald " GYROCAL_VERSION);
  runner::RunRequest request;
  std::string database;
  std::string settings_path;
  app.add_option("campaign", request.campaign_path, "campaign file (TOML)")->required();
  app.add_option("--db", database, "database; default: the campaign file's");
  app.add_option("--settings", settings_path,
                 fmt::format("status page and messages; default: {} beside the campaign file",
                             daemon_settings_name));
  const cli::Parsed parsed = app.parse(argc, argv);
  if (parsed == cli::Parsed::helped) return cli::exit_done;
  if (parsed == cli::Parsed::refused) return cli::exit_bad_input;
  if (!database.empty()) request.database = database;
  request.resume = true;
  request.unattended = true;
  request.software_version = GYROCAL_VERSION;
  log_to_stderr();
  const auto settings = settings_of(settings_path, request.campaign_path);
  if (!settings) return cli::report(settings.error());
  return run(std::move(request), *settings);
}
