// Session directories that are not what they should be: file, line, column, what, expected.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "schema/session/session_csv.h"
#include "tests/schema/small_session.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

/// The error of a small session after `change`, without the folder's name.
Error error_of(const Session& session, const std::string& file = {}, const std::string& text = {}) {
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "s", session));
  if (!file.empty()) write_file(folder / ("s/" + file), text);
  const auto read = read_session(folder / "s");
  if (read) return {Errc::timeout, "it was read", ""};
  auto error = read.error();
  const auto prefix = folder / "s/";
  for (auto at = error.what.find(prefix); at != std::string::npos; at = error.what.find(prefix)) {
    error.what.erase(at, prefix.size());
  }
  return error;
}

const std::string samples_header =
    "dwell,seq,t_s,gyro_z_dps,acc_x_g,acc_y_g,acc_z_g,board_c,chamber_c\n";
const std::string sound_row = "0,0,20,4,,,,21.5,20\n";

std::string samples_error(const std::string& rows) {
  return error_of(small_session(), "samples.csv", samples_header + rows).what;
}
std::string monitor_error(const std::string& rows) {
  return error_of(small_session(), "monitor.csv",
                  "t_s,setpoint_c,chamber_c,board_c,gyro_z_dps\n" + rows)
      .what;
}
std::string head_error(const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  REQUIRE(write_session(folder / "s", small_session()));
  std::string text = R"({"format":"session-csv/1","device":"d","axis":"z","unit":"deg/s",
"sample_rate_hz":10,"monitor_interval_s":5,"lsb_dps":0.25,"samples_per_dwell":12,
"dwells":[{"dwell":0,"setpoint_c":-10,"t_start_s":20},{"dwell":1,"setpoint_c":20,"t_start_s":40}]})";
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return error_of(small_session(), "session.json", text).what;
}

}  // namespace

TEST_CASE("bad rows are named by file, line and column", "[session][bad]") {
  CHECK(samples_error(sound_row + "0,1,20.1,nan,,,,21,20\n") ==
        "samples.csv line 3, column 4 (gyro_z_dps): \"nan\", expected a finite number");
  CHECK(samples_error("0,0,20,1e999,,,,21,20\n") ==
        "samples.csv line 2, column 4 (gyro_z_dps): \"1e999\", expected a finite number");
  CHECK(samples_error("0,0,20,4.1x,,,,21,20\n") ==
        "samples.csv line 2, column 4 (gyro_z_dps): \"4.1x\", expected a finite number");
  CHECK(samples_error("0,0,,4,,,,21,20\n") ==
        "samples.csv line 2, column 3 (t_s): is empty, expected a number");
  CHECK(samples_error("0,0,20,4,,,,21\n") ==
        "samples.csv line 2: 8 fields, expected 9 as in the header");
  CHECK(samples_error("0,0,20,4,,,,21,20,\n") ==
        "samples.csv line 2: 10 fields, expected 9 as in the header");
  CHECK(samples_error("0,0.5,20,4,,,,21,20\n") ==
        "samples.csv line 2, column 2 (seq): 0.5, expected a whole number from 0 to 2147483647");
  CHECK(samples_error("-1,0,20,4,,,,21,20\n") ==
        "samples.csv line 2, column 1 (dwell): -1, expected a whole number from 0 to 2147483647");
  CHECK(samples_error(sound_row + "\n" + sound_row) ==
        "samples.csv line 3, column 1 (dwell): is empty, expected a number");
  CHECK(samples_error("") == "samples.csv: no rows below the header");
  CHECK(error_of(small_session(), "samples.csv", samples_header + "0,0,20,inf,,,,21,20\n").code ==
        Errc::not_finite);
}

TEST_CASE("rows out of order are named", "[session][bad]") {
  CHECK(samples_error(sound_row + "0,1,19.9,4,,,,21,20\n") ==
        "samples.csv line 3, column 3 (t_s): 19.9 s after 20 s: time runs backwards");
  CHECK(samples_error(sound_row + "0,0,20,4,,,,21,20\n") ==
        "samples.csv line 3, column 2 (seq): seq 0 of dwell 0 stands twice");
  CHECK(samples_error("0,5,20,4,,,,21,20\n0,4,20,4,,,,21,20\n") ==
        "samples.csv line 3, column 2 (seq): 4 after 5: seq runs backwards");
  CHECK(samples_error(sound_row + "1,0,40,4,,,,21,20\n0,1,40.1,4,,,,21,20\n") ==
        "samples.csv line 4, column 1 (dwell): dwell 0 again, after dwell 1");
  CHECK(samples_error("7,0,20,4,,,,21,20\n") ==
        "samples.csv line 2, column 1 (dwell): dwell 7 is not listed in session.json");
  CHECK(monitor_error("5,,,,4\n10,,,,4\n7,,,,4\n") ==
        "monitor.csv line 4, column 1 (t_s): 7 s after 10 s: time runs backwards");
  CHECK(monitor_error("5,,,,4\n5,,,,4\n") ==
        "monitor.csv line 3, column 1 (t_s): 5 s stands twice");
}

TEST_CASE("a session recorded without a slow stream has a monitor without rows", "[session]") {
  CHECK(monitor_error("") == "it was read");
}

TEST_CASE("headers that lack or mistype a column are named", "[session][bad]") {
  const auto header = [](const std::string& text) {
    return error_of(small_session(), "monitor.csv", text);
  };
  CHECK(header("time,gyro_z_dps\n").what ==
        "monitor.csv line 1: no column \"t_s\" in \"time,gyro_z_dps\"");
  const auto mistyped = header("t_s,chamber_C,gyro_z_dps\n");
  CHECK(mistyped.what ==
        "monitor.csv line 1: no column \"chamber_c\" in \"t_s,chamber_C,gyro_z_dps\"");
  CHECK(mistyped.advice == "is \"chamber_C\" meant?");
  CHECK(header("t_s,t_s\n").what == "monitor.csv line 1, column 2: the name \"t_s\" stands twice");
  CHECK(header("").what == "monitor.csv line 1: no column \"t_s\" in \"\"");
}

TEST_CASE("a session.json that contradicts its format is named by key", "[session][bad]") {
  CHECK(head_error("\"deg/s\"", "\"rad/s\"") ==
        "session.json: unit = \"rad/s\", expected \"deg/s\": multiply the rates by 57.29578");
  CHECK(head_error("session-csv/1", "session-csv/2") ==
        "session.json: format = \"session-csv/2\", expected \"session-csv/1\"");
  CHECK(head_error("\"z\"", "\"yaw\"") ==
        "session.json: axis = \"yaw\", expected \"x\", \"y\" or \"z\"");
  CHECK(head_error("\"sample_rate_hz\":10", "\"sample_rate_hz\":\"10\"") ==
        "session.json: sample_rate_hz = \"10\", expected a number above 0");
  CHECK(head_error("\"sample_rate_hz\":10,", "") ==
        "session.json: sample_rate_hz is missing, expected a number above 0");
  CHECK(head_error("0.25", "0") ==
        "session.json: lsb_dps = 0, expected the size of one count in deg/s, above 0");
  CHECK(head_error("\"t_start_s\":40", "\"t_start_s\":null") ==
        "session.json: dwells[1].t_start_s = null, expected a number");
  CHECK(head_error("\"dwell\":1", "\"dwell\":0") ==
        "session.json: dwells[1].dwell = 0 stands twice");
  CHECK(head_error("\"dwell\":1", "\"dwell\":1.5") ==
        "session.json: dwells[1].dwell = 1.5, expected a whole number from 0 to 2147483647");
  CHECK(head_error("5,\"lsb_dps\"", "NaN,\"lsb_dps\"") ==
        "session.json line 2, column 42: not JSON");
  auto no_dwells = small_session();
  no_dwells.dwells.clear();
  CHECK(error_of(no_dwells).what ==
        "session.json: dwells, expected an array with at least one dwell");
}

TEST_CASE("a session that contradicts itself is said so", "[session][bad]") {
  auto session = small_session();
  session.sample_rate_hz = 50;
  CHECK_THAT(
      error_of(session).what,
      Catch::Contains("session.json: sample_rate_hz = 50, but seq and t_s in samples.csv say "
                      "10 Hz"));
  session = small_session();
  session.dwells[1].t_start_s = 4000;
  CHECK_THAT(error_of(session).what,
             Catch::Contains("session.json: dwell 1 starts at 4000 s, outside the record in "
                             "monitor.csv, 2.5 to 57.5 s"));
  session = small_session();
  for (std::size_t i = 12; i < 24; ++i) session.samples[i].t_s += 5000;
  CHECK_THAT(error_of(session).what,
             Catch::Contains("samples.csv: dwell 1 has a sample at 5040 s, outside the record"));
  session = small_session();
  for (auto& sample : session.samples) sample.t_s = 20;
  CHECK_THAT(error_of(session).what, Catch::Contains("samples.csv say inf Hz"));
}

TEST_CASE("a dwell in a gap at the end of the monitor's record is read", "[session]") {
  const TemporaryFolder folder;
  auto session = small_session();
  session.dwells[1].t_start_s += 220;
  for (std::size_t i = 12; i < 24; ++i) session.samples[i].t_s += 220;
  REQUIRE(write_session(folder / "s", session));
  CHECK(read_session(folder / "s").has_value());
}

TEST_CASE("a session directory with a file missing names the file", "[session][bad]") {
  const auto nowhere = read_session("/nowhere");
  REQUIRE_FALSE(nowhere.has_value());
  CHECK(nowhere.error().what == "read /nowhere/session.json: No such file or directory");
  for (const char* name : {"monitor.csv", "samples.csv"}) {
    const TemporaryFolder folder;
    REQUIRE(write_session(folder / "s", small_session()));
    std::filesystem::remove((folder / "s/") + name);
    const auto read = read_session(folder / "s");
    REQUIRE_FALSE(read.has_value());
    CHECK(read.error().what == "read " + (folder / "s/") + name + ": No such file or directory");
  }
}
