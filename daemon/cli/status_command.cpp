#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/campaign.h"
#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/status_watch.h"
#include "daemon/runner/control_socket.h"
#include "daemon/runner/progress.h"

namespace gyrocal::cli {
namespace {

struct StatusOptions {
  std::string campaign;
  bool as_json = false;
  bool watch = false;
};

std::vector<std::string> sockets_of_running_campaigns() {
  namespace fs = std::filesystem;
  std::vector<std::string> running;
  for (const auto& folder : runner::folders_of_running_campaigns()) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      if (entry.path().extension() == ".sock") running.push_back(entry.path().string());
    }
  }
  std::sort(running.begin(), running.end());
  return running;
}

std::string campaign_of(const std::string& socket) {
  return std::filesystem::path(socket).stem().string();
}

/// The socket of the campaign a person means: of a file, of a name, or of the only one that runs.
Result<std::string> socket_meant(std::string campaign) {
  if (campaign.ends_with(".toml")) {
    const auto config = read_campaign(campaign);
    if (!config) return tl::unexpected(config.error());
    campaign = config->name;
  }
  const auto running = sockets_of_running_campaigns();
  if (campaign.empty() && running.size() == 1) return running.front();
  std::string names;
  for (const auto& socket : running) {
    if (campaign_of(socket) == campaign) return socket;
    names += fmt::format(" {}", campaign_of(socket));
  }
  if (running.empty()) {
    return fail(Errc::link_lost,
                fmt::format("no campaign runs{} (no socket in {})",
                            campaign.empty() ? "" : fmt::format(" by the name {}", campaign),
                            runner::runtime_folder()),
                "begin one: gyrocal run CAMPAIGN.toml");
  }
  if (campaign.empty()) {
    return fail(Errc::link_lost, "several campaigns run:" + names, "name one of them");
  }
  return fail(Errc::link_lost, "campaign " + campaign + " does not run; these do:" + names,
              "name one of them");
}

int tell(const std::string& command, const StatusOptions& options) {
  const auto path = socket_meant(options.campaign);
  if (!path) return report(path.error());
  if (options.watch) return watch_campaign(*path, options.as_json);
  const auto line = runner::ask_campaign(*path, command);
  if (!line) return report(line.error());
  const auto answer = nlohmann::json::parse(*line, nullptr, false);
  if (options.as_json) {
    fmt::print("{}\n", *line);
  } else if (!answer.value("ok", true)) {
    fmt::print(stderr, "gyrocal: {}: {}\n", command, answer.value("why", ""));
  } else {
    fmt::print("{}\n", answer.value("text", ""));
    if (command == "status") {
      fmt::print("  {} of {} setpoints, chamber at {:.1f} degC, {} of {} boards, {} left\n",
                 answer.value("setpoints_done", 0), answer.value("setpoints", 0),
                 answer.value("chamber_c", 0.0), answer.value("boards_present", 0),
                 answer.value("boards", 0),
                 runner::clock_text(seconds(answer.value("left_s", 0.0))));
    }
  }
  return answer.value("ok", true) ? exit_done : exit_failed;
}

struct Added {
  Command* command;
  std::shared_ptr<StatusOptions> options;
};

Added add_one(Command& root, Chosen& chosen, const std::string& name, const std::string& help) {
  auto* command =
      root.add_subcommand(name, fmt::format("Example: gyrocal {} weekend\n{}", name, help));
  const auto options = std::make_shared<StatusOptions>();
  command->add_option("campaign", options->campaign,
                      "its name or its file; default: the one that runs");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback(
      [name, options, &chosen] { chosen = [name, options] { return tell(name, *options); }; });
  return {command, options};
}

}  // namespace

void add_status(Command& root, Chosen& chosen) {
  const auto status = add_one(root, chosen, "status",
                              "         gyrocal status --watch\nWhere a running campaign stands.");
  status.command->add_flag(
      "--watch", status.options->watch,
      "until it ends: one line drawn again each second, or, where stdout is no terminal, a line\n"
      "whenever something changes; NO_COLOR turns colours off");
  add_one(root, chosen, "pause",
          "Holds the chamber where it is; a running dwell is repeated later.");
  add_one(root, chosen, "resume", "Goes on after a pause.");
  add_one(root, chosen, "skip", "Goes on with the next setpoint.");
  add_one(root, chosen, "abort", "Brings the chamber to its safe setpoint and ends the campaign.");
}

}  // namespace gyrocal::cli
