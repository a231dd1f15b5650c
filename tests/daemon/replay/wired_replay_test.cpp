// Campaigns over real TCP and pseudo-terminals, recorded as they always are there, and done again.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "config/text_file.h"
#include "daemon/replay/recorded_span.h"
#include "schema/compare_campaigns.h"
#include "schema/open_database.h"
#include "tests/daemon/replay/recorded_campaign.h"
#include "tests/daemon/runner/served_rig.h"

namespace gyrocal::replay {
namespace {

using runner::campaign_text;
using runner::rig_scale;
using runner::ServedRig;
using runner::TemporaryFolder;

constexpr double flushed_every_s = rig_scale;  // a second of the machine's

runner::RunRequest request_in(const TemporaryFolder& folder, const ServedRig& rig) {
  runner::RunRequest request;
  request.campaign_path = folder.write("wired.toml", campaign_text(folder, rig.port()));
  request.database = folder / "wired.db";
  request.software_version = "test";
  return request;
}

/// Whether the daemon has begun, as it says itself; gives up after two minutes.
bool began(const std::string& log) {
  for (int i = 0; i < 1200; ++i) {
    const auto said = read_text_file(log);
    if (said && said->find("-> ramping") != std::string::npos) return true;
    ::usleep(100'000);
  }
  return false;
}

/// gyrocald, killed a while after it began or left to end.
int run_daemon(const TemporaryFolder& folder, std::optional<useconds_t> killed_after_us) {
  const std::string campaign = folder / "wired.toml";
  const std::string database = folder / "wired.db";
  const pid_t daemon = ::fork();
  if (daemon == 0) {
    static_cast<void>(::freopen((folder / "log").c_str(), "a", stderr));
    ::execl(GYROCALD_PROGRAM, "gyrocald", campaign.c_str(), "--db", database.c_str(), nullptr);
    ::_exit(127);
  }
  if (killed_after_us) {
    CHECK(began(folder / "log"));
    ::usleep(*killed_after_us);  // the instant does not matter: any is good
    ::kill(daemon, SIGKILL);
  }
  int status = 0;
  ::waitpid(daemon, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<EventInsert> journal(const std::string& path) {
  const auto database = open_to_read(path);
  REQUIRE(database);
  const auto events = events_in({*database, CampaignId{1}});
  REQUIRE(events);
  return *events;
}

}  // namespace

SCENARIO("a campaign on real endpoints is recorded and does the same again, a stop included") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  runner::RunHooks hooks = quiet();
  const bool is_stopped = GENERATE(false, true);
  int turns = 0;
  hooks.progress = [&](const runner::Snapshot&) { ++turns; };
  hooks.stop_asked = [&] { return is_stopped && turns > 100; };
  const auto outcome = run_requested(request_in(folder, rig), hooks, [](auto&&...) {});
  if (!outcome) FAIL(to_text(outcome.error()));
  const auto report = replayed({folder / "wired.recording.db"});
  CHECK(report.passed());
  REQUIRE(report.runs.size() == 1);
  CHECK_FALSE(report.runs[0].cut_off);
  CHECK(report.runs[0].ended.find(is_stopped ? "stopped while" : "finished") == 0);
  if (!is_stopped) CHECK(report.runs[0].samples == 2 * 3 * 200);
}

SCENARIO("killed in the middle, the recording lacks at most the last second, and is done again") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  static_cast<void>(request_in(folder, rig));
  CHECK(run_daemon(folder, 3'000'000) == -1);
  const double stored_to_s = double(journal(folder / "wired.db").back().t_ns) * 1e-9;
  const auto cut = replayed({folder / "wired.recording.db"});
  CHECK(cut.passed());
  REQUIRE(cut.runs.size() == 1);
  CHECK(cut.runs[0].cut_off);
  CHECK(to_seconds(cut.runs[0].to) >= stored_to_s - flushed_every_s);
  CHECK(report_text(cut).find("before the run did") != std::string::npos);

  CHECK(run_daemon(folder, std::nullopt) == 0);  // it goes on by itself
  const auto whole = replayed({folder / "wired.recording.db"});
  CHECK(whole.passed());
  REQUIRE(whole.runs.size() == 2);
  CHECK(whole.runs[0].cut_off);
  CHECK(whole.runs[1].ended == "finished");
  CHECK(whole.runs[1].models > 0);
}

SCENARIO("a chamber told after a trip by the next daemon is recorded and told again") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  static_cast<void>(request_in(folder, rig));
  CHECK(run_daemon(folder, 2'000'000) == -1);
  sql(folder / "wired.db", "UPDATE campaign SET state = 'safe'");  // it tripped as it died
  CHECK(run_daemon(folder, std::nullopt) == 3);
  CHECK(journal(folder / "wired.db").back().kind == "safe_setpoint");
  const auto report = replayed({folder / "wired.recording.db"});
  CHECK(report.passed());
  REQUIRE(report.runs.size() == 2);
  CHECK(report.runs[1].ended == "safe, completed");
  CHECK(report.runs[1].passed.requests > 0);
  CHECK(recorded_spans(folder / "wired.recording.db")->size() == 2);
}

SCENARIO("a recording that cannot go on is told once and costs the campaign nothing") {
  const TemporaryFolder folder;
  const ServedRig rig(folder);
  const auto request = request_in(folder, rig);
  const std::string recording = folder / "wired.recording.db";
  runner::RunHooks hooks = quiet();
  bool full = false;
  const bool from_the_start = GENERATE(true, false);
  if (from_the_start) std::filesystem::create_directory(recording);
  hooks.progress = [&](const runner::Snapshot& now) {
    if (from_the_start || full || now.state != "soaking") return;
    full = true;
    sql(recording,
        "CREATE TRIGGER full BEFORE INSERT ON piece BEGIN SELECT RAISE(FAIL, 'no room'); END");
  };
  const auto outcome = run_requested(request, hooks, [](auto&&...) {});
  if (!outcome) FAIL(to_text(outcome.error()));
  CHECK(std::holds_alternative<campaign::Finished>(outcome->state));
  int told = 0;
  for (const auto& event : journal(folder / "wired.db")) {
    if (event.kind != "not_recorded") continue;
    ++told;
    CHECK(event.text.find(from_the_start ? "unable to open" : "no room") != std::string::npos);
  }
  CHECK(told == 1);
  if (from_the_start) return;
  const auto report = replayed({recording});
  CHECK(report.passed());
  CHECK(report.runs.at(0).cut_off);
  CHECK(report.runs.at(0).unchecked_rows > 0);
}

}  // namespace gyrocal::replay
