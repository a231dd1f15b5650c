#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "schema/migrate.h"
#include "schema/session/session_csv.h"
#include "schema/sqlite.h"
#include "tests/daemon/cli/run_gyrocal.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/small_session.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

void make_database(const std::string& path) {
  auto store = Store::open(path).value();
  const auto ids = small_campaign::begin(store);
  REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
}

}  // namespace

TEST_CASE("a session directory goes into a database and comes out again", "[cli][store]") {
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "monday", small_session()));
  const auto in = run_gyrocal("import " + (folder / "monday/") + " --db " + (folder / "lab.db"));
  CHECK(in.exit_code == 0);
  CHECK(in.out ==
        folder / "lab.db" + ": campaign 1 \"monday\", 2 dwells, 24 samples, 12 monitor rows\n");
  CHECK_THAT(in.err, Catch::Contains("not imported: the accelerometer's columns"));

  const auto out = run_gyrocal("export --db " + (folder / "lab.db") + " --session " +
                               (folder / "again") + " --json");
  CHECK(out.exit_code == 0);
  const auto json = nlohmann::json::parse(out.out);
  CHECK(json["board"] == "bench");
  CHECK(json["axis"] == "y");
  CHECK(json["samples"] == 24);
  const auto again = read_session(folder / "again").value();
  CHECK(again.samples[17].gyro_dps == small_session().samples[17].gyro_dps);
  CHECK(again.lsb_dps == 0.25);
}

TEST_CASE("the version is told as an option and as a command", "[cli]") {
  const auto told = run_gyrocal("--version");
  CHECK(told.exit_code == 0);
  CHECK(told.out == run_gyrocal("version").out);
  CHECK(told.out.starts_with("gyrocal "));
}

TEST_CASE("gyrocal db lists the campaigns, people's way and as JSON", "[cli][store]") {
  const TemporaryFolder folder;
  make_database(folder / "a.db");
  const auto text = run_gyrocal("db " + (folder / "a.db"));
  CHECK(text.exit_code == 0);
  CHECK(text.out ==
        "campaign 1 \"small\": preflight, began 2023-11-14 22:13:20 UTC\n"
        "  1 of 3 setpoints logged, 2 dwells accepted, 0 rejected, 10 samples\n"
        "  board \"first\" axes xyz on /dev/first\n"
        "  board \"second\" axes xyz on /dev/second\n");
  const auto json = nlohmann::json::parse(run_gyrocal("db " + (folder / "a.db") + " --json").out);
  REQUIRE(json.size() == 1);
  CHECK(json[0]["setpoints"] == 3);
  CHECK(run_gyrocal("db").exit_code == 2);
  CHECK(run_gyrocal("db " + (folder / "none.db")).exit_code == 1);
}

TEST_CASE("gyrocal db checks, copies and migrates", "[cli][store]") {
  const TemporaryFolder folder;
  make_database(folder / "a.db");
  CHECK(run_gyrocal("db check " + (folder / "a.db")).out == folder / "a.db" + ": sound\n");
  CHECK(run_gyrocal("db check --json " + (folder / "a.db")).out == "{\"problems\":[]}\n");
  const auto copied = run_gyrocal("db backup " + (folder / "a.db") + " " + (folder / "b.db"));
  CHECK(copied.exit_code == 0);
  CHECK(dump(folder / "a.db") == dump(folder / "b.db"));
  CHECK(run_gyrocal("db backup " + (folder / "a.db") + " " + (folder / "b.db")).exit_code == 1);
  CHECK(run_gyrocal("db migrate " + (folder / "a.db")).out ==
        fmt::format("{}: schema {}, nothing to do\n", folder / "a.db",
                    newest_version(embedded_migrations())));
  REQUIRE(Database::open(folder / "a.db", OpenMode::read_write_create)
              .value()
              .execute("DELETE FROM sample WHERE seq = 1"));
  const auto checked = run_gyrocal("db check " + (folder / "a.db"));
  CHECK(checked.exit_code == 4);
  CHECK(checked.out ==
        "dwell 1 counts 5 samples, 4 are stored\ndwell 2 counts 5 samples, 4 are stored\n");
}

TEST_CASE("any table or view is printed as CSV or JSON", "[cli][store]") {
  const TemporaryFolder folder;
  make_database(folder / "a.db");
  const auto csv = run_gyrocal("export --db " + (folder / "a.db") + " --table setpoint");
  CHECK(csv.exit_code == 0);
  CHECK(csv.out == "campaign_id,ordinal,setpoint_c\n1,0,-10\n1,1,20\n1,2,50\n");
  const auto quoted = run_gyrocal("export --db " + (folder / "a.db") + " --table campaign");
  CHECK_THAT(quoted.out, Catch::Contains(",\"[campaign]\nname = \"\"small\"\"\n\","));
  const auto json = nlohmann::json::parse(
      run_gyrocal("export --db " + (folder / "a.db") + " --table dwell --json").out);
  REQUIRE(json.size() == 2);
  CHECK(json[1]["chamber_mean_c"] == 30.1);
  CHECK(json[1]["reject_reason"].is_null());
  CHECK(run_gyrocal("export --db " + (folder / "a.db") + " --table finding --json").out == "[]\n");
}

TEST_CASE("choices that are not clear or not there are answered with what is there",
          "[cli][store][bad]") {
  const TemporaryFolder folder;
  make_database(folder / "a.db");
  const auto exported = [&](const std::string& rest) {
    return run_gyrocal("export --db " + (folder / "a.db") + " " + rest);
  };
  const auto session = "--session " + (folder / "s");
  CHECK_THAT(exported(session).err,
             Catch::Contains("campaign 1 has 2 boards, --board says which\n  advice: its boards: "
                             "first, second"));
  CHECK_THAT(exported(session + " --board third").err, Catch::Contains("has no board \"third\""));
  CHECK_THAT(exported(session + " --board frist").err, Catch::Contains("is \"first\" meant?"));
  CHECK_THAT(exported(session + " --board first --axis yaw").err,
             Catch::Contains("board \"first\" has no axis \"yaw\"\n  advice: its axes: xyz"));
  CHECK_THAT(exported(session + " --campaign 9").err, Catch::Contains("no campaign 9"));
  CHECK(exported(session + " --campaign 9").exit_code == 2);
  CHECK_THAT(exported("--table zero_drfit").err, Catch::Contains("is \"zero_drift\" meant?"));
  CHECK(exported("").exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "s"));
  CHECK(exported(session + " --board first").exit_code == 0);
}

TEST_CASE("an import that cannot be leaves the database as it was", "[cli][store][bad]") {
  const TemporaryFolder folder;
  make_database(folder / "a.db");
  const auto before = dump(folder / "a.db");
  auto session = small_session();
  session.samples[7].gyro_dps = 4.1;
  REQUIRE(write_session(folder / "s", session));
  const auto refused = run_gyrocal("import " + (folder / "s") + " --db " + (folder / "a.db"));
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Catch::Contains("dwell 0, seq 7: 4.1 deg/s is 16.400 counts"));
  CHECK(dump(folder / "a.db") == before);
  CHECK(run_gyrocal("import /nowhere --db " + (folder / "a.db")).exit_code == 2);
}
