// One file out of a campaign, for a bug report.
#include "daemon/replay/capsule.h"

#include "tests/daemon/replay/recorded_campaign.h"

namespace gyrocal::replay {
namespace {

using runner::TemporaryFolder;

/// A campaign stopped in the middle and resumed: two runs.
struct TwoRuns {
  TwoRuns() {
    runner::RunHooks hooks = quiet();
    int turns = 0;
    hooks.stop_asked = [&] { return ++turns > 300; };
    REQUIRE(record_virtually(folder, small_campaign, hooks));
    REQUIRE(record_virtually(folder, small_campaign, quiet(), true));
  }
  [[nodiscard]] CapsuleRequest request() const {
    CapsuleRequest request;
    request.database = folder / "small.db";
    request.out = folder / "bug.capsule";
    request.software_version = "test";
    return request;
  }
  TemporaryFolder folder;
};

Capsule cut(const CapsuleRequest& request) {
  const auto capsule = cut_capsule(request);
  if (!capsule) FAIL(to_text(capsule.error()));
  return *capsule;
}

/// Replays with nothing but the capsule left.
ReplayReport replayed_elsewhere(const CapsuleRequest& request) {
  const TemporaryFolder elsewhere;
  std::filesystem::copy(request.out, elsewhere / "a");
  return replayed({elsewhere / "a"});
}

}  // namespace

SCENARIO("a capsule of a whole campaign replays elsewhere, models included") {
  const TwoRuns recorded;
  const Capsule capsule = cut(recorded.request());
  CHECK(capsule.runs == 2);
  CHECK(capsule.from == Duration{});
  CHECK(capsule.note.find("campaign 1, 0:00:00 to ") == 0);
  const auto report = replayed_elsewhere(recorded.request());
  CHECK(report.passed());
  REQUIRE(report.runs.size() == 2);
  CHECK(report.runs[1].ended == "finished");
  CHECK(report.runs[1].models > 0);
  CHECK(report.against.find("cut out by gyrocal test") != std::string::npos);
}

SCENARIO("a capsule's window holds the runs it touches, from their beginning to its own end") {
  const TwoRuns recorded;
  CapsuleRequest request = recorded.request();
  SECTION("in the first run") {
    request.from = seconds(600);
    request.to = seconds(700);
    const Capsule capsule = cut(request);
    CHECK(capsule.runs == 1);
    CHECK(capsule.from == Duration{});
    CHECK(capsule.to == seconds(700));
    const auto report = replayed_elsewhere(request);
    CHECK(report.passed());
    REQUIRE(report.runs.size() == 1);
    CHECK(report.runs[0].cut_off);
    CHECK(report.runs[0].to <= seconds(700));
    CHECK(report.runs[0].to > seconds(690));
    CHECK(report.runs[0].decisions > 0);
  }
  SECTION("in the second, which began with what the first had stored") {
    request.from = seconds(1600);
    const Capsule capsule = cut(request);
    CHECK(capsule.runs == 1);
    CHECK(capsule.from > seconds(1500));
    const auto report = replayed_elsewhere(request);
    CHECK(report.passed());
    REQUIRE(report.runs.size() == 1);
    CHECK(report.runs[0].ended == "finished");
    CHECK(report.runs[0].models > 0);
  }
}

SCENARIO("a capsule shows what differs, where the campaign's own files are not at hand") {
  const TwoRuns recorded;
  sql(recorded.folder / "small.db",
      "UPDATE sample SET gyro_x_lsb = 5 WHERE dwell_id = 2 AND seq = 9");
  cut(recorded.request());
  const auto report = replayed_elsewhere(recorded.request());
  REQUIRE(report.difference);
  CHECK(report.difference->what == "sample");
}

SCENARIO("a capsule that cannot be cut says why, and leaves nothing behind") {
  const TwoRuns recorded;
  CapsuleRequest request = recorded.request();
  request.from = seconds(1e6);
  const auto outside = cut_capsule(request);
  REQUIRE_FALSE(outside);
  CHECK(outside.error().code == Errc::bad_input);
  CHECK(outside.error().advice.find("what was recorded: 0:00:00 to 0:25:00") == 0);
  CHECK_FALSE(std::filesystem::exists(request.out));
  CHECK_FALSE(std::filesystem::exists(request.out + ".unfinished"));

  request = recorded.request();
  request.campaign = 9;
  CHECK_FALSE(cut_capsule(request));
  request = recorded.request();
  cut(request);
  CHECK(cut_capsule(request).error().code == Errc::busy);
  std::filesystem::remove(recorded.folder / "small.recording.db");
  request.out = recorded.folder / "b.capsule";
  CHECK(cut_capsule(request).error().code == Errc::storage);
}

}  // namespace gyrocal::replay
