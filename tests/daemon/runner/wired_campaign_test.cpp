// A campaign over real TCP and pseudo-terminals, against the rig's server in another thread.
#include <fmt/core.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <map>
#include <thread>

#include "daemon/runner/check.h"
#include "daemon/runner/control_socket.h"
#include "daemon/runner/device_lock.h"
#include "daemon/runner/make_safe.h"
#include "daemon/runner/owned_devices.h"
#include "daemon/runner/run_request.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::runner {
namespace {

RunHooks quiet() {
  RunHooks hooks;
  hooks.log = [](const EventInsert&) {};
  return hooks;
}

/// One setpoint, where the rig stands already: a campaign that takes seconds at real speed.
std::string real_speed_campaign(const TemporaryFolder& folder, int port) {
  return fmt::format(R"([campaign]
name = "real-{}"
simulated = true
[plan]
setpoints_c = [23]
samples_per_setpoint = 400
sample_rate_hz = 100
safe_setpoint_c = 23
[chamber]
profile = "yinhe"
host = "127.0.0.1"
port = {}
[[board]]
name = "left"
device = "{}"
[stability]
air_window_s = 10
board_window_s = 10
soak_s_min = 10
)",
                     ::getpid(), port, folder / "board0");
}

}  // namespace

SCENARIO("at real speed, a dwell shorter than a chamber poll still has its samples and its air") {
  const TemporaryFolder folder;
  const ServedRig rig(folder, {}, 1.0);
  RunRequest request;
  request.campaign_path = folder.write("real.toml", real_speed_campaign(folder, rig.port()));
  std::map<std::string, int> events;
  RunHooks hooks;
  hooks.log = [&](const EventInsert& event) { ++events[event.kind]; };
  std::vector<DwellRow> dwells;
  std::size_t samples = 0;
  const auto outcome =
      run_requested(request, hooks, [&](const Store& store, CampaignId campaign, auto&&) {
        dwells = *store.dwells(campaign);
        const auto boards = store.boards(campaign);
        REQUIRE(boards);
        for (const auto& [id, board] : *boards) {
          const auto accepted = store.accepted_dwells(campaign, id);
          REQUIRE(accepted);
          for (const auto& dwell : *accepted) samples += store.samples(dwell.id)->size();
        }
      });
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Finished>(outcome->state));
  REQUIRE(dwells.size() == 1);
  CHECK(samples == 400);
  CHECK(dwells[0].frames_missing == 0);
  CHECK(dwells[0].chamber_mean_c == Approx(23).margin(0.5));
  CHECK(dwells[0].t_end_ns - dwells[0].t_start_ns == Approx(4e9).margin(0.2e9));
  for (const char* trouble : {"board_lost", "chamber_lost", "trip", "clock_step"}) {
    CAPTURE(trouble);
    CHECK(events[trouble] == 0);
  }
}

SCENARIO("three setpoints, two boards, through libmodbus and libserialport to stored models") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  RunRequest request;
  request.campaign_path = folder.write("wired.toml", campaign_text(folder, rig.port()));
  request.software_version = "test";
  RunHooks hooks = quiet();
  const std::string socket = control_path(fmt::format("wired-{}", ::getpid()));
  std::string answer;
  std::thread operator_asks;
  hooks.progress = [&](const Snapshot& now) {
    if (now.state != "soaking" || operator_asks.joinable()) return;
    operator_asks = std::thread([&] {
      if (auto status = ask_campaign(socket, "status")) answer = *status;
    });
  };
  std::size_t accepted = 0;
  const auto outcome =
      run_requested(request, hooks, [&](const Store& store, CampaignId campaign, auto&&) {
        const auto boards = store.boards(campaign);
        REQUIRE(boards);
        for (const auto& [id, board] : *boards) {
          const auto dwells = store.accepted_dwells(campaign, id);
          REQUIRE(dwells);
          for (const auto& dwell : *dwells) accepted += store.samples(dwell.id)->size();
        }
      });
  if (operator_asks.joinable()) operator_asks.join();
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Finished>(outcome->state));
  CHECK(accepted == 2 * 3 * 200);
  CHECK(answer.find("\"setpoints\":3") != std::string::npos);
}

SCENARIO("on real endpoints: a board unplugged, the chamber gone, a trip, and resumed to the end") {
  const TemporaryFolder folder;
  const ServedRig rig(folder, {{RigFaultKind::unplug, 300, 600, 0, 0},
                               {RigFaultKind::refuse, 1500, 6000, std::nullopt, 0}});
  RunRequest request;
  request.campaign_path = folder.write("wired.toml", campaign_text(folder, rig.port()));
  std::map<std::string, int> events;
  RunHooks hooks;
  hooks.log = [&](const EventInsert& event) { ++events[event.kind]; };
  const auto tripped = run_requested(request, hooks, [](auto&&...) {});
  if (!tripped) FAIL(to_text(tripped.error()));
  REQUIRE(std::holds_alternative<campaign::Safe>(tripped->state));
  CHECK(events["board_lost"] == 1);
  CHECK(events["board_back"] == 1);
  CHECK(events["chamber_lost"] == 1);
  CHECK(events["chamber_back"] == 1);
  CHECK(events["safe_setpoint"] == 1);

  request.resume = true;  // a person re-arms it
  std::size_t accepted = 0;
  const auto outcome =
      run_requested(request, hooks, [&](const Store& store, CampaignId campaign, auto&&) {
        const auto boards = store.boards(campaign);
        REQUIRE(boards);
        for (const auto& [id, board] : *boards) {
          accepted += store.accepted_dwells(campaign, id)->size();
        }
      });
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Finished>(outcome->state));
  CHECK(accepted == 6);
}

SCENARIO("an operator pauses, is refused a second pause, resumes, and aborts") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  RunRequest request;
  request.campaign_path = folder.write("wired.toml", campaign_text(folder, rig.port()));
  RunHooks hooks = quiet();
  const std::string socket = control_path(fmt::format("wired-{}", ::getpid()));
  std::vector<std::string> answers;
  std::thread operator_asks;
  hooks.progress = [&](const Snapshot& now) {
    if (now.state != "soaking" || operator_asks.joinable()) return;
    operator_asks = std::thread([&] {
      for (const char* command : {"pause", "pause", "resume", "abort", "explode"}) {
        auto answer = ask_campaign(socket, command);
        answers.push_back(answer ? *answer : to_text(answer.error()));
      }
    });
  };
  const auto outcome = run_requested(request, hooks, [](auto&&...) {});
  operator_asks.join();
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Aborted>(outcome->state));
  REQUIRE(answers.size() == 5);
  CHECK(answers[0].find("\"state\":\"paused\"") != std::string::npos);
  CHECK(answers[1].find("\"ok\":false") != std::string::npos);
  CHECK(answers[2].find("\"ok\":true") != std::string::npos);
  CHECK(answers[3].find("\"state\":\"returning\"") != std::string::npos);
}

SCENARIO("check finds what is there, and make-safe moves the chamber") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const auto config = parse_campaign(campaign_text(folder, rig.port()), folder / "c.toml");
  if (!config) FAIL(to_text(config.error()));
  const auto owned = wired_devices(*config);
  auto devices = owned->devices();
  const auto report =
      check_campaign(*config, devices, wired_options(*config).patience, folder / "c.db");
  if (!report) FAIL(to_text(report.error()));
  for (const auto& device : report->devices) {
    INFO(device.name << ": " << (device.found ? *device.found : to_text(device.found.error())));
    CHECK(device.found.has_value());
  }
  CHECK(report->passed());
  CHECK_FALSE(std::filesystem::exists(folder / "c.db"));

  REQUIRE(devices.chamber.set_setpoint(Celsius{55}));
  REQUIRE(make_chamber_safe(*config, devices.chamber, devices.clock, seconds(600)));
  CHECK(devices.chamber.read()->setpoint == Celsius{25});
}

SCENARIO("a chamber is commanded by one process, and the second learns who has it") {
  const TemporaryFolder folder;
  const auto config = parse_campaign(campaign_text(folder, 15999), folder / "c.toml");
  REQUIRE(config);
  const auto first = lock_chamber(config->chamber);
  REQUIRE(first);
  const auto second = lock_chamber(config->chamber);
  REQUIRE_FALSE(second);
  CHECK(second.error().code == Errc::busy);
  CHECK(second.error().what.find(fmt::format("process {}", ::getpid())) != std::string::npos);
}

}  // namespace gyrocal::runner
