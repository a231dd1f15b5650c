// The generator and the judge as programs: what they write, and what they say about finders whose
// faults are known.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/hidden_effects/run_program.h"

namespace fs = std::filesystem;
using Rows = std::vector<std::vector<std::string>>;

namespace {

Rows read_csv(const fs::path& file) {
  Rows rows;
  std::istringstream lines(hidden::read_file(file));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back().push_back(c);
      }
    }
    rows.push_back(cells);
  }
  return rows;
}

/// For a program that this one starts; sanitized ones take their time.
constexpr double allowed_s = 120.0 * SLOWDOWN;

/// Written once for all test cases of this program.
const fs::path& sessions() {
  static const fs::path folder = [] {
    const fs::path made = fs::current_path() / "hidden_sessions_of_test";
    fs::remove_all(made);
    fs::create_directories(made);
    for (const char* only : {"null_up_1", "dropped_samples_strong", "bias_jump_strong",
                             "outside_supply_ripple", "confounded_thermal_lag"}) {
      const auto ran = hidden::run_program({HIDDEN_SESSIONS, "--out", made.string(), "--set",
                                            "short", "--seed", "5", "--only", only},
                                           made / "log", allowed_s);
      REQUIRE(ran.trouble.empty());
    }
    return made;
  }();
  return folder;
}

std::vector<fs::path> session_folders() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(sessions() / "sessions"))
    folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

hidden::Ran judge_a_finder_that_is(const std::string& mood) {
  setenv("FAKE_MOOD", mood.c_str(), 1);
  return hidden::run_program(
      {HIDDEN_JUDGE, "--gyrocal", FAKE_GYROCAL, "--sessions", sessions().string(), "--jobs", "2",
       "--junit", (sessions() / (mood + ".xml")).string()},
      sessions() / ("judge_" + mood), allowed_s);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

TEST_CASE("a session holds the three files of session-csv/1 and nothing that tells its secret") {
  for (const auto& folder : session_folders()) {
    INFO(folder);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"monitor.csv", "samples.csv", "session.json"});
    const auto head = nlohmann::json::parse(hidden::read_file(folder / "session.json"));
    for (const char* key : {"format", "device", "axis", "unit", "sample_rate_hz",
                            "monitor_interval_s", "lsb_dps", "samples_per_dwell", "dwells"}) {
      CHECK(head.contains(key));
    }
    CHECK(head.size() == 9);
    CHECK(head["format"] == "session-csv/1");
    CHECK(head["unit"] == "deg/s");
  }
}

TEST_CASE("rows are whole, times go forward, and dwells lie where the session says") {
  for (const auto& folder : session_folders()) {
    INFO(folder);
    const auto head = nlohmann::json::parse(hidden::read_file(folder / "session.json"));
    const Rows monitor = read_csv(folder / "monitor.csv");
    const Rows samples = read_csv(folder / "samples.csv");
    CHECK(monitor[0] ==
          std::vector<std::string>{"t_s", "setpoint_c", "chamber_c", "board_c", "gyro_z_dps"});
    CHECK(samples[0] == std::vector<std::string>{"dwell", "seq", "t_s", "gyro_z_dps", "acc_x_g",
                                                 "acc_y_g", "acc_z_g", "board_c", "chamber_c"});
    double before_s = -1.0;
    bool forward = true;
    for (std::size_t i = 1; i < monitor.size(); ++i) {
      forward = forward && monitor[i].size() == 5 && std::stod(monitor[i][0]) > before_s;
      before_s = std::stod(monitor[i][0]);
    }
    CHECK(forward);
    const double rate_hz = head["sample_rate_hz"];
    const double lsb_dps = head["lsb_dps"];
    bool in_place = true;
    bool on_code = true;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      REQUIRE(samples[i].size() == 9);
      const double start_s = head["dwells"].at(std::stoul(samples[i][0]))["t_start_s"];
      const double seq = std::stod(samples[i][1]);
      in_place = in_place && seq < head["samples_per_dwell"].get<double>() &&
                 std::abs(std::stod(samples[i][2]) - start_s - seq / rate_hz) < 0.02;
      const double codes = std::stod(samples[i][3]) / lsb_dps;
      on_code = on_code && std::abs(codes - std::round(codes)) < 1e-4;
    }
    CHECK(in_place);
    CHECK(on_code);
  }
}

TEST_CASE("a monitor row is the mean of the samples the dwell kept in it") {
  const fs::path folder = session_folders().front();
  const auto head = nlohmann::json::parse(hidden::read_file(folder / "session.json"));
  const double interval_s = head["monitor_interval_s"];
  std::map<long, std::pair<double, int>> means;
  for (const auto& row : read_csv(folder / "samples.csv")) {
    if (row[0] == "dwell") continue;
    auto& [sum, count] = means[std::lround(std::floor(std::stod(row[2]) / interval_s))];
    sum += std::stod(row[3]);
    ++count;
  }
  const auto full = static_cast<int>(interval_s * head["sample_rate_hz"].get<double>());
  int compared = 0;
  for (const auto& row : read_csv(folder / "monitor.csv")) {
    if (row[0] == "t_s") continue;
    const auto found = means.find(std::lround(std::floor(std::stod(row[0]) / interval_s)));
    if (found == means.end() || found->second.second < full) continue;
    CHECK(std::stod(row[4]) == Approx(found->second.first / found->second.second).margin(2e-3));
    ++compared;
  }
  CHECK(compared > 10);
}

TEST_CASE("lost samples leave holes in seq, as many as the truth says") {
  for (const auto& entry : fs::directory_iterator(sessions() / "truth")) {
    const auto truth = nlohmann::json::parse(hidden::read_file(entry.path()));
    if (truth["case"] != "dropped_samples_strong_1") continue;
    const fs::path folder = sessions() / "sessions" / truth["session"].get<std::string>();
    const auto head = nlohmann::json::parse(hidden::read_file(folder / "session.json"));
    const double asked =
        head["samples_per_dwell"].get<double>() * static_cast<double>(head["dwells"].size());
    const double kept = static_cast<double>(read_csv(folder / "samples.csv").size() - 1);
    CHECK(truth["effects"][0]["amplitude"].get<double>() ==
          Approx(1.0 - kept / asked).margin(1e-9));
    CHECK(kept < asked);
    return;
  }
  FAIL("no session with lost samples");
}

TEST_CASE("the same seed writes the same session") {
  const fs::path again = sessions().parent_path() / "hidden_sessions_again";
  fs::create_directories(again);
  const auto ran = hidden::run_program(
      {HIDDEN_SESSIONS, "--out", again.string(), "--seed", "5", "--only", "null_up_1"},
      again / "log", 60.0);
  REQUIRE(ran.trouble.empty());
  for (const char* file : {"session.json", "monitor.csv", "samples.csv"}) {
    CHECK(hidden::read_file(again / "sessions/0001" / file) ==
          hidden::read_file(sessions() / "sessions/0001" / file));
  }
}

TEST_CASE("a perfect finder passes every target") {
  const auto ran = judge_a_finder_that_is("perfect");
  INFO(ran.output);
  CHECK(ran.trouble.empty());
  CHECK(ends_with(ran.output, "\n8 passed, 0 failed\n"));
  CHECK(hidden::read_file(sessions() / "perfect.xml").find("failures=\"0\"") != std::string::npos);
}

TEST_CASE("a silent finder names nothing false and finds nothing") {
  const auto ran = judge_a_finder_that_is("silent");
  INFO(ran.output);
  CHECK(ran.trouble == "exit code 1");
  CHECK(std::regex_search(ran.output, std::regex("ok +false names on nulls +0.0 %")));
  CHECK(std::regex_search(ran.output, std::regex("FAIL +strong effects named +0.0 %")));
  CHECK(std::regex_search(ran.output, std::regex("FAIL +confounded said +0.0 %")));
}

TEST_CASE("a careless finder is told of its false and wrong names") {
  const auto ran = judge_a_finder_that_is("careless");
  INFO(ran.output);
  CHECK(std::regex_search(ran.output, std::regex("FAIL +false names on nulls +100.0 %")));
  CHECK(std::regex_search(ran.output, std::regex("FAIL +wrong names +100.0 %")));
  CHECK(hidden::read_file(sessions() / "careless.xml").find("null_up_1") != std::string::npos);
}

TEST_CASE("a finder that fails to answer is no consistent one") {
  const auto ran = judge_a_finder_that_is("broken");
  INFO(ran.output);
  CHECK(ran.trouble == "exit code 1");
  CHECK(std::regex_search(ran.output, std::regex("FAIL +every session answered +0.0 %")));
}

TEST_CASE("the generator and the judge include nothing of the tree but this folder") {
  static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
  int read = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(GYROCAL_SOURCE_DIR) / "tests/hidden_effects")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    ++read;
    std::istringstream lines(hidden::read_file(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      INFO(entry.path() << ": " << line);
      CHECK(match[1].str().rfind("tests/hidden_effects/", 0) == 0);
    }
  }
  CHECK(read > 30);
}
