#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <string>

#include "daemon/replay/replay.h"
#include "daemon/runner/run_request.h"
#include "schema/sqlite.h"
#include "tests/daemon/runner/temporary_folder.h"

namespace gyrocal::replay {

/// Two setpoints, one board, a minute's dwells: seconds of virtual time are cheap, bytes are not.
inline const std::string small_campaign = R"([campaign]
name = "small"
simulated = true
[plan]
setpoints_c = [24, 27, 30, 33]
samples_per_setpoint = 64
sample_rate_hz = 1
ramp_k_per_min = 2
safe_setpoint_c = 25
[chamber]
profile = "yinhe"
host = "127.0.0.1"
[[board]]
name = "left"
device = "/dev/left"
[stability]
air_window_s = 120
board_window_s = 300
soak_s_min = 300
[analysis]
level = 2
)";

/// Runs `text` in virtual time, recorded, into folder/small.db and folder/small.recording.db.
inline Result<runner::Outcome> record_virtually(const runner::TemporaryFolder& folder,
                                                const std::string& text,
                                                const runner::RunHooks& hooks,
                                                bool resume = false) {
  runner::RunRequest request;
  request.campaign_path = folder.write("small.toml", text);
  request.database = folder / "small.db";
  request.virtual_rig = runner::VirtualRig{7, {}};
  request.record = true;
  request.resume = resume;
  request.software_version = "test";
  return runner::run_requested(request, hooks, [](auto&&...) {});
}

inline runner::RunHooks quiet() {
  runner::RunHooks hooks;
  hooks.log = [](const EventInsert&) {};
  return hooks;
}

inline ReplayReport replayed(const ReplayRequest& request) {
  auto report = replay(request);
  if (!report) FAIL(to_text(report.error()));
  CHECK(report->repeatable);
  UNSCOPED_INFO(report_text(*report));  // of the next assertion, if it fails
  return *report;
}

inline void sql(const std::string& database, const std::string& what) {
  const auto opened = Database::open(database, OpenMode::read_write_create);
  REQUIRE(opened);
  const auto done = opened->execute(what);
  if (!done) FAIL(to_text(done.error()));
}

}  // namespace gyrocal::replay
