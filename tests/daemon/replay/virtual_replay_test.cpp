// Campaigns in virtual time, recorded and done again.
#include "tests/daemon/replay/recorded_campaign.h"

namespace gyrocal::replay {
namespace {

using runner::TemporaryFolder;

/// A finished small campaign and its recording.
struct Recorded {
  Recorded() {
    const auto outcome = record_virtually(folder, small_campaign, quiet());
    if (!outcome) FAIL(to_text(outcome.error()));
    REQUIRE(std::holds_alternative<campaign::Finished>(outcome->state));
  }
  TemporaryFolder folder;
  std::string recording = folder / "small.recording.db";
};

}  // namespace

SCENARIO("a recorded campaign does the same again: commands, decisions, samples, models") {
  const Recorded recorded;
  const auto report = replayed({recorded.recording});
  CHECK(report_text(report).find("DIFFERS") == std::string::npos);
  CHECK(report.passed());
  REQUIRE(report.runs.size() == 1);
  const ReplayedRun& run = report.runs[0];
  CHECK(run.ended == "finished");
  CHECK_FALSE(run.cut_off);
  CHECK(run.dwells == 4);
  CHECK(run.samples == 4 * 64);
  CHECK(run.models >= 3 * 3);
  CHECK(run.decisions == 15);
  CHECK(run.monitor_rows > 0);
}

SCENARIO("a stop, a resumption and an operator's commands are part of what is done again") {
  const TemporaryFolder folder;
  runner::RunHooks hooks = quiet();
  int turns = 0;
  hooks.stop_asked = [&] { return ++turns > 300; };
  const auto stopped = record_virtually(folder, small_campaign, hooks);
  REQUIRE(stopped);
  CHECK(stopped->stopped);
  int asked = 0;
  hooks.stop_asked = nullptr;
  hooks.next_command = [&]() -> std::optional<campaign::Event> {
    ++asked;
    if (asked == 20) return campaign::PauseAsked{};
    if (asked == 50) return campaign::ResumeAsked{};
    if (asked == 100) return campaign::SkipAsked{};
    return std::nullopt;
  };
  REQUIRE(record_virtually(folder, small_campaign, hooks, true));
  const auto report = replayed({folder / "small.recording.db"});
  CHECK(report.passed());
  REQUIRE(report.runs.size() == 2);
  CHECK(report.runs[0].ended.find("stopped while") == 0);
  CHECK(report.runs[1].ended == "finished");
  CHECK(report.runs[1].from > report.runs[0].to);
  CHECK(report.runs[0].dwells + report.runs[1].dwells >= 3);
}

SCENARIO("a database that could not be written ends the replay where it ended the campaign") {
  const TemporaryFolder folder;
  runner::RunHooks hooks = quiet();
  int turns = 0;
  hooks.progress = [&](const runner::Snapshot&) {
    if (++turns != 200) return;
    sql(folder / "small.db",
        "CREATE TRIGGER full BEFORE INSERT ON event BEGIN SELECT RAISE(FAIL, 'no room'); END");
  };
  const auto outcome = record_virtually(folder, small_campaign, hooks);
  REQUIRE_FALSE(outcome);
  const auto report = replayed({folder / "small.recording.db"});
  CHECK(report.passed());
  CAPTURE(report.runs.at(0).ended);
  CHECK(report.runs.at(0).ended == to_text(outcome.error()));
  CHECK(report.runs.at(0).ended.find("store event") != std::string::npos);
  CHECK(report.runs.at(0).decisions > 0);
}

SCENARIO("a looser stability limit decides earlier, and the first such decision is named") {
  const Recorded recorded;
  std::string looser = small_campaign;
  looser.replace(looser.find("soak_s_min = 300"), 16, "soak_s_min = 200");
  const auto campaign = recorded.folder.write("looser.toml", looser);
  const auto report = replayed({recorded.recording, std::nullopt, campaign});
  CHECK_FALSE(report.passed());
  REQUIRE(report.difference);
  CHECK(report.difference->what == "decision");
  CHECK(report.difference->got == "transition: soaking -> logging at 24.0 degC (point 1 of 4)");
  CHECK(report.difference->sentence.find("where the recorded campaign went on") !=
        std::string::npos);
}

SCENARIO("a campaign to decide by needs no chamber profile: the recording has its own") {
  const Recorded recorded;
  std::string elsewhere = small_campaign;
  elsewhere.replace(elsewhere.find("yinhe"), 5, "a profile of another laboratory");
  const auto campaign = recorded.folder.write("elsewhere.toml", elsewhere);
  CHECK(replayed({recorded.recording, std::nullopt, campaign}).passed());
}

SCENARIO("a stricter stability limit, written into the recording, decides later") {
  const Recorded recorded;
  sql(recorded.recording,
      "UPDATE run SET campaign_text = replace(campaign_text, 'soak_s_min = 300', "
      "'soak_s_min = 400')");
  const auto report = replayed({recorded.recording});
  REQUIRE(report.difference);
  CHECK(report.difference->what == "decision");
  CHECK(report.difference->expected.find(
            "transition: soaking -> logging at 24.0 degC (point 1 of 4)") != std::string::npos);
  CHECK(report.difference->sentence.find("the replay does not") != std::string::npos);
}

SCENARIO("a sample, a model or a journal line changed afterwards is found") {
  const Recorded recorded;
  const std::string database = recorded.folder / "small.db";
  SECTION("sample") {
    sql(database, "UPDATE sample SET gyro_y_lsb = gyro_y_lsb + 1 WHERE dwell_id = 3 AND seq = 17");
    const auto report = replayed({recorded.recording});
    REQUIRE(report.difference);
    CHECK(report.difference->what == "sample");
    CHECK(report.difference->sentence.find("board left, setpoint 2, attempt 1, seq 17") !=
          std::string::npos);
    CHECK(report.difference->expected.find("gyro_y_lsb") == 0);
  }
  SECTION("model") {
    sql(database,
        "UPDATE model SET rmse_dps = rmse_dps * 1.00001 WHERE axis = 'y' AND method = 'gm11'");
    const auto report = replayed({recorded.recording});
    REQUIRE(report.difference);
    CHECK(report.difference->what == "model");
    CHECK(report.difference->sentence.find("axis y, method gm11") != std::string::npos);
  }
  SECTION("prediction band") {
    sql(database, "UPDATE model_point SET band_dps = band_dps * 1.00001");
    const auto report = replayed({recorded.recording});
    REQUIRE(report.difference);
    CHECK(report.difference->expected.find("band_dps") == 0);
  }
  SECTION("what an earlier schema did not keep is not held against the recording") {
    sql(database,
        "UPDATE model SET block_rmse_dps = NULL, effective_parameters = NULL, warnings = '';"
        "UPDATE model_point SET band_dps = NULL");
    CHECK(replayed({recorded.recording}).passed());
  }
  SECTION("journal") {
    sql(database, "DELETE FROM event WHERE id = 4");
    const auto report = replayed({recorded.recording});
    REQUIRE(report.difference);
    CHECK(report.difference->what == "decision");
  }
}

SCENARIO("another ramp sends other setpoints: the first command that differs is named") {
  const Recorded recorded;
  std::string slower = small_campaign;
  slower.replace(slower.find("ramp_k_per_min = 2"), 18, "ramp_k_per_min = 1");
  const auto campaign = recorded.folder.write("slower.toml", slower);
  const auto report = replayed({recorded.recording, std::nullopt, campaign});
  REQUIRE(report.difference);
  CHECK(report.difference->what == "command");
  CHECK(report.difference->expected.find("ask chamber 01 10 06 ce") == 0);
  CHECK(report.difference->got.find("ask chamber 01 10 06 ce") == 0);
  CHECK(report.difference->expected.find("(setpoint ") != std::string::npos);
  CHECK(report.difference->sentence.find("the replay does: ask chamber") != std::string::npos);
}

}  // namespace gyrocal::replay
