// What cannot be replayed says why.
#include <fstream>

#include "tests/daemon/replay/recorded_campaign.h"

namespace gyrocal::replay {
namespace {

using runner::TemporaryFolder;

struct RecordedQuietly {
  RecordedQuietly() { REQUIRE(record_virtually(folder, small_campaign, quiet())); }
  TemporaryFolder folder;
  std::string recording = folder / "small.recording.db";
};

Error refusal(const ReplayRequest& request) {
  const auto report = replay(request);
  if (report) FAIL(report_text(*report));
  return report.error();
}

bool says(const Error& error, const std::string& part) {
  CAPTURE(to_text(error));
  return to_text(error).find(part) != std::string::npos;
}

}  // namespace

SCENARIO("files that are no recording, of a newer format, empty or damaged are refused by name") {
  const RecordedQuietly recorded;
  const TemporaryFolder& folder = recorded.folder;
  const std::string text = folder.write("notes.recording.db", "not a database at all\n");
  CHECK(says(refusal({text}), "file is not a database"));
  CHECK(says(refusal({folder / "absent.recording.db"}), "does it exist"));
  const Error database = refusal({folder / "small.db"});
  CHECK(database.code == Errc::mismatch);
  CHECK(says(database, "not a recording"));

  SECTION("newer") {
    sql(recorded.recording, "PRAGMA user_version = 2");
    const Error error = refusal({recorded.recording});
    CHECK(error.code == Errc::mismatch);
    CHECK(says(error, "written by a newer gyrocal, in format 2; this one reads up to 1"));
  }
  SECTION("empty") {
    sql(recorded.recording, "DELETE FROM piece; DELETE FROM stream; DELETE FROM run");
    CHECK(says(refusal({recorded.recording}), "holds no run"));
  }
  SECTION("a bit turned over") {
    sql(recorded.recording,
        "UPDATE piece SET data = CAST(substr(data, 1, 2000) || x'5a' || substr(data, 2002) AS "
        "BLOB)");
    CHECK(refusal({recorded.recording}).code == Errc::bad_frame);
  }
  SECTION("the first piece gone") {
    sql(recorded.recording, "UPDATE piece SET seq = seq + 1");
    CHECK(says(refusal({recorded.recording}), "piece 0 of run 1 of the recording is missing"));
  }
  SECTION("circumstances unreadable") {
    sql(recorded.recording, "UPDATE run SET circumstances = '{}'");
    CHECK(refusal({recorded.recording}).code == Errc::bad_frame);
  }
}

SCENARIO("without its database, or with another's, a recording is not compared") {
  const RecordedQuietly recorded;
  const TemporaryFolder& folder = recorded.folder;
  std::filesystem::rename(folder / "small.db", folder / "elsewhere.db");
  CHECK(says(refusal({recorded.recording}), "small.db: no such database to compare with"));
  CHECK(replayed({recorded.recording, folder / "elsewhere.db"}).passed());

  std::filesystem::rename(recorded.recording, folder / "renamed");
  CHECK(says(refusal({folder / "renamed"}), "which database does it belong to"));

  sql(folder / "elsewhere.db", "UPDATE campaign SET utc_start_ns = utc_start_ns + 1");
  CHECK(says(refusal({folder / "renamed", folder / "elsewhere.db"}),
             "not the campaign that was recorded"));
}

}  // namespace gyrocal::replay
