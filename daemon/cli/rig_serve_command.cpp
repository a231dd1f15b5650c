#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "config/campaign.h"
#include "config/rig_faults.h"
#include "config/rig_model.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/rig_command.h"
#include "drivers/clocks.h"
#include "drivers/simulated/rig_server.h"

namespace gyrocal::cli {
namespace {

constexpr std::size_t host_buffer_bytes = 20480;  // what Linux holds of a port nobody reads

struct ServeOptions {
  std::string campaign;
  std::size_t boards = 2;
  int port = 15020;
  std::string link_dir;
  std::optional<double> time_scale;
  std::uint64_t seed = 1;
  std::string rig_model = default_rig_model;
  std::string fault;
  bool as_json = false;
};

struct ServePlan {
  RigEndpoints endpoints;
  std::vector<std::string> board_names;
  ChamberProfile profile;
  int unit = 1;
  double time_scale = 1.0;
};

std::string default_link_dir() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime != '\0') return fmt::format("{}/gyrocal-rig", runtime);
  return (std::filesystem::temp_directory_path() / fmt::format("gyrocal-rig-{}", ::getuid()))
      .string();
}

Result<ServePlan> plan_of(const ServeOptions& options) {
  constexpr const char* profile = "yinhe";
  const auto file = find_chamber_profile(profile, "");
  if (!file) return fail(Errc::storage, "chamber profile \"yinhe\": not found", "make install?");
  auto read = read_chamber_profile(*file);
  if (!read) return tl::unexpected(read.error());
  ServePlan plan;
  plan.unit = read->unit_default;
  plan.profile = *std::move(read);
  plan.time_scale = options.time_scale.value_or(1.0);
  plan.endpoints.port = options.port;
  const std::string folder = options.link_dir.empty() ? default_link_dir() : options.link_dir;
  for (std::size_t index = 0; index < options.boards; ++index) {
    plan.board_names.push_back(fmt::format("board{}", index));
    plan.endpoints.links.push_back(fmt::format("{}/{}", folder, plan.board_names.back()));
  }
  return plan;
}

Result<ServePlan> plan_of(const CampaignConfig& campaign, const ServeOptions& options) {
  if (!campaign.simulated) {
    return fail(Errc::bad_input,
                fmt::format("{}: its devices are real ones; expected simulated = true in "
                            "[campaign]",
                            options.campaign),
                "a simulated board must never take a real one's name");
  }
  const auto* const address = std::get_if<TcpAddress>(&campaign.chamber.address);
  if (address == nullptr) {
    return fail(Errc::bad_input,
                fmt::format("{}: chamber.device: the simulated chamber speaks Modbus TCP; "
                            "expected host and port",
                            options.campaign),
                "host = \"127.0.0.1\"");
  }
  ServePlan plan;
  plan.endpoints.host = address->host;
  plan.endpoints.port = address->port;
  plan.profile = campaign.chamber.profile;
  plan.unit = campaign.chamber.unit;
  plan.time_scale = options.time_scale.value_or(campaign.time_scale);
  for (const BoardConfig& board : campaign.boards) {
    plan.board_names.push_back(board.name);
    plan.endpoints.links.push_back(board.device);
  }
  return plan;
}

Result<ServePlan> make_plan(const ServeOptions& options) {
  if (options.campaign.empty()) return plan_of(options);
  const auto campaign = read_campaign(options.campaign);
  if (!campaign) return tl::unexpected(campaign.error());
  return plan_of(*campaign, options);
}

std::string mcu_text(std::size_t index) {
  return fmt::format("{:02x}", fmt::join(simulated_mcu_id(index), ""));
}

void print_json(const ServePlan& plan, const ServeOptions& options, const RigServer& server) {
  nlohmann::json boards = nlohmann::json::array();
  for (std::size_t index = 0; index < server.boards().size(); ++index) {
    boards.push_back({{"device", server.boards()[index].link()}, {"mcu_id", mcu_text(index)}});
  }
  const nlohmann::json all{{"chamber",
                            {{"host", plan.endpoints.host},
                             {"port", server.port()},
                             {"unit", plan.unit},
                             {"profile", plan.profile.name}}},
                           {"boards", boards},
                           {"time_scale", plan.time_scale},
                           {"seed", options.seed},
                           {"rig_model", options.rig_model}};
  fmt::print("{}\n", all.dump());
}

void print_lines(const ServePlan& plan, const ServeOptions& options, const RigServer& server) {
  fmt::print("chamber   {}:{}  unit {}, {}\n", plan.endpoints.host, server.port(), plan.unit,
             plan.profile.name);
  for (std::size_t index = 0; index < server.boards().size(); ++index) {
    fmt::print("board {:<3} {}  MCU {}\n", index, server.boards()[index].link(), mcu_text(index));
  }
  fmt::print("ready: {:g} s of campaign time a second, rig model {}, seed {}; Ctrl-C ends it\n",
             plan.time_scale, options.rig_model, options.seed);
}

/// Readable once somebody wants us to end. Blocks these signals' own effect from now on.
Result<UniqueFd> end_signals() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
  UniqueFd fd(sigprocmask(SIG_BLOCK, &ending, nullptr) == 0 ? signalfd(-1, &ending, SFD_CLOEXEC)
                                                            : -1);
  if (!fd.is_open()) {
    return fail(Errc::storage, fmt::format("signalfd: {}", std::strerror(errno)));
  }
  return fd;
}

Result<void> serve(const ServeOptions& options) {
  const auto plan = make_plan(options);
  if (!plan) return tl::unexpected(plan.error());
  const auto model = read_rig_model(options.rig_model);
  if (!model) return tl::unexpected(model.error());
  Result<std::vector<RigFault>> faults;
  if (!options.fault.empty()) faults = read_rig_faults(options.fault, plan->board_names);
  if (!faults) return tl::unexpected(faults.error());
  const auto stop = end_signals();
  if (!stop) return tl::unexpected(stop.error());

  // The host's buffer holds as much of our time at any scale: a busy machine is late in our time.
  const auto buffer_bytes =
      static_cast<std::size_t>(host_buffer_bytes * std::max(1.0, plan->time_scale));
  ScaledClock clock(plan->time_scale);
  SimulatedRig rig(*model, options.seed, plan->endpoints.links.size(), plan->profile, plan->unit,
                   buffer_bytes);
  rig.set_faults(*std::move(faults));
  auto server = RigServer::open(rig, clock, plan->endpoints, plan->time_scale);
  if (!server) return tl::unexpected(server.error());
  options.as_json ? print_json(*plan, options, *server) : print_lines(*plan, options, *server);
  std::fflush(stdout);
  return server->run(stop->get());
}

void add_options(Command& command, ServeOptions& options) {
  auto* const campaign = command.add_option(
      "--campaign", options.campaign,
      "serve what this campaign file names: address, profile, devices, time scale");
  command.add_option("--boards", options.boards, "number of boards")
      ->within(1, 64)
      ->capture_default_str()
      ->excludes(campaign);
  command.add_option("--port", options.port, "Modbus TCP port on 127.0.0.1; 0: any free one")
      ->within(0, 65535)
      ->capture_default_str()
      ->excludes(campaign);
  command
      .add_option("--link-dir", options.link_dir,
                  "directory of the boards' links [$XDG_RUNTIME_DIR/gyrocal-rig]")
      ->excludes(campaign);
  command.add_option("--time-scale", options.time_scale, "campaign seconds in a second")
      ->within(1e-3, 1e5);
  command.add_option("--seed", options.seed, "of noise and spread")->capture_default_str();
  command.add_option("--rig-model", options.rig_model, "file, or name of a shipped one")
      ->capture_default_str();
  command.add_option("--fault", options.fault, "TOML list of what goes wrong, and when");
  command.add_flag("--json", options.as_json, "print the addresses as one line of JSON");
}

}  // namespace

void add_rig_serve(Command& rig, Chosen& chosen) {
  auto* command = rig.add_subcommand(
      "serve",
      "Example: gyrocal rig serve --campaign config/campaigns/demo.toml\n"
      "Serves the simulated chamber (Modbus TCP) and boards (pseudo-terminals) until Ctrl-C;\n"
      "prints their addresses, then \"ready\".");
  const auto options = std::make_shared<ServeOptions>();
  add_options(*command, *options);
  command->callback([options, &chosen] {
    chosen = [options] {
      const auto served = serve(*options);
      return served ? exit_done : report(served.error());
    };
  });
}

}  // namespace gyrocal::cli
