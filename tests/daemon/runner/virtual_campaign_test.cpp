// A whole campaign, from preflight to stored models, over the virtual clock: the daemon's own loop,
// drivers and codecs against the simulated rig in process.
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>

#include "daemon/runner/model_table.h"
#include "daemon/runner/run_request.h"
#include "tests/daemon/runner/temporary_folder.h"

namespace gyrocal::runner {
namespace {

const std::string demo = std::string(GYROCAL_SOURCE_DIR) + "/config/campaigns/demo.toml";

Outcome run_virtual(const std::string& database, std::uint64_t seed) {
  RunRequest request;
  request.campaign_path = demo;
  request.database = database;
  request.virtual_rig = VirtualRig{seed, {}};
  request.software_version = "test";
  RunHooks hooks;
  hooks.log = [](const EventInsert&) {};
  const auto outcome = run_requested(request, hooks, [](auto&&...) {});
  if (!outcome) FAIL(to_text(outcome.error()));
  return *outcome;
}

std::string sql(const std::string& database, const std::string& what) {
  const std::string command = "sqlite3 '" + database + "' '" + what + "'";
  FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  std::array<char, 65536> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    text.append(buffer.data(), got);
  }
  REQUIRE(::pclose(pipe) == 0);
  return text;
}

}  // namespace

SCENARIO("25 setpoints, two boards: every dwell, every row of the slow stream, every model") {
  const TemporaryFolder folder;
  const std::string database = folder / "a.db";
  const Outcome outcome = run_virtual(database, 7);
  REQUIRE(std::holds_alternative<campaign::Finished>(outcome.state));
  CHECK(std::get<campaign::Finished>(outcome.state).models);

  CHECK(sql(database, "SELECT state FROM campaign") == "finished\n");
  CHECK(sql(database, "SELECT count(*) FROM dwell WHERE reject_reason IS NULL") == "50\n");
  CHECK(sql(database, "SELECT count(*) FROM sample") == "150000\n");
  CHECK(sql(database, "SELECT count(DISTINCT board_id) FROM monitor") == "2\n");
  // A row per board every 5 s of the whole campaign, ramps included, with all their frames.
  CHECK(sql(database,
            "SELECT max(t_ns) - min(t_ns) = (count(*) - 1) * 5000000000, min(t_ns) FROM monitor "
            "WHERE board_id = 1") == "1|2500000000\n");
  CHECK(sql(database,
            "SELECT count(*) FROM monitor WHERE frames NOT BETWEEN 249 AND 251 AND t_ns > 5e9 AND "
            "t_ns < (SELECT max(t_ns) FROM monitor)") == "0\n");
  CHECK(sql(database, "SELECT count(*) FROM monitor WHERE chamber_c IS NULL") <= "2\n");
  // The paper's three methods at least, for three axes of two boards; one of each is recommended.
  CHECK(sql(database,
            "SELECT count(*) FROM model WHERE method IN "
            "(\"gm11\", \"improved_gm11\", \"least_squares\")") == "18\n");
  CHECK(sql(database, "SELECT count(*) FROM model WHERE recommended = 1") == "6\n");
  CHECK(sql(database, "SELECT count(DISTINCT dwells_sha256) FROM model") == "2\n");
  // Drift as the paper's: 4.04 to 4.38 deg/s over the setpoints, here with the simulation's noise.
  CHECK(sql(database,
            "SELECT min(filtered_mean_dps) > 3.9 AND max(filtered_mean_dps) < 4.6 FROM zero_drift "
            "WHERE axis = \"z\" AND board = \"board0\"") == "1\n");
  // preflight -> ramping, then ramping, soaking, logging at each setpoint, and home.
  CHECK(sql(database, "SELECT count(*) FROM event WHERE kind = \"transition\"") == "78\n");
  CHECK(sql(database, "SELECT count(*) FROM event WHERE severity <> \"info\"") == "0\n");

  const auto store = Store::open_read_only(database);
  REQUIRE(store);
  const auto table = model_table(*store, outcome.campaign);
  REQUIRE(table);
  CHECK(table->find("improved GM(1,1)") != std::string::npos);
}

SCENARIO("the same seed gives the same database to the last byte of its dump, another does not") {
  const TemporaryFolder folder;
  run_virtual(folder / "a.db", 7);
  run_virtual(folder / "b.db", 7);
  run_virtual(folder / "c.db", 8);
  const std::string a = sql(folder / "a.db", ".dump");
  CHECK(a.size() > 5'000'000);
  CHECK(a == sql(folder / "b.db", ".dump"));
  CHECK(a != sql(folder / "c.db", ".dump"));
}

SCENARIO("a database with a campaign that has ended takes another; one not ended is not run over") {
  const TemporaryFolder folder;
  run_virtual(folder / "a.db", 7);
  const Outcome second = run_virtual(folder / "a.db", 8);
  CHECK(static_cast<std::int64_t>(second.campaign) == 2);
  sql(folder / "a.db", "UPDATE campaign SET state = \"soaking\" WHERE id = 2");
  RunRequest request;
  request.campaign_path = demo;
  request.database = folder / "a.db";
  request.virtual_rig = VirtualRig{9, {}};
  RunHooks hooks;
  hooks.log = [](const EventInsert&) {};
  const auto third = run_requested(request, hooks, [](auto&&...) {});
  REQUIRE_FALSE(third);
  CHECK(third.error().code == Errc::busy);
  CHECK(third.error().advice.find("--resume") != std::string::npos);
}

SCENARIO("a stop anywhere is made good by --resume: no dwell lost, none twice") {
  for (const int stop_after_turns : {3, 700, 1500, 4000}) {
    CAPTURE(stop_after_turns);
    const TemporaryFolder folder;
    RunRequest request;
    request.campaign_path = demo;
    request.database = folder / "a.db";
    request.virtual_rig = VirtualRig{7, {}};
    RunHooks hooks;
    hooks.log = [](const EventInsert&) {};
    int turns = 0;
    hooks.stop_asked = [&] { return ++turns > stop_after_turns; };
    const auto stopped = run_requested(request, hooks, [](auto&&...) {});
    REQUIRE(stopped);
    CHECK(stopped->stopped);
    request.resume = true;
    hooks.stop_asked = nullptr;
    const auto finished = run_requested(request, hooks, [](auto&&...) {});
    REQUIRE(finished);
    CHECK(std::holds_alternative<campaign::Finished>(finished->state));
    CHECK(finished->campaign == stopped->campaign);
    CHECK(sql(folder / "a.db", "SELECT count(*) FROM dwell WHERE reject_reason IS NULL") == "50\n");
    CHECK(sql(folder / "a.db", "SELECT count(*) FROM dwell WHERE reject_reason IS NOT NULL") <=
          "2\n");
  }
}

}  // namespace gyrocal::runner
