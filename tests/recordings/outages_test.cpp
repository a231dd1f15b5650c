// The recorded campaign of this folder, as a CI replays it: without devices, by the command line.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/daemon/cli/run_gyrocal.h"

namespace gyrocal {
namespace {

const std::string folder = std::string(GYROCAL_SOURCE_DIR) + "/tests/recordings/";
const std::string capsule = folder + "outages.capsule";

std::string campaign_with(const std::string& line, const std::string& instead) {
  std::stringstream text;
  text << std::ifstream(folder + "outages.toml").rdbuf();
  std::string changed = text.str();
  REQUIRE(changed.find(line) != std::string::npos);
  changed.replace(changed.find(line), line.size(), instead);
  return temporary_file("changed.toml", changed);
}

}  // namespace

SCENARIO("a campaign with outages, a kill -9 and an operator does the same today") {
  const Ran ran = run_gyrocal("replay " + capsule + " --json");
  INFO(ran.out << ran.err);
  INFO("if the change is intended: tests/recordings/README.md says how to record anew");
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json.at("passed") == true);
  CHECK(json.at("repeatable") == true);
  const auto& runs = json.at("runs");
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].at("cut_off") == true);
  CHECK(runs[1].at("ended") == "finished");
  CHECK(runs[0].at("samples").get<int>() + runs[1].at("samples").get<int>() >= 2 * 4 * 128);
  CHECK(runs[1].at("models").get<int>() >= 2 * 3 * 3);
}

SCENARIO("with another stability limit it does not, and the decision that differs is named") {
  const std::string looser = campaign_with("soak_s_min = 300", "soak_s_min = 200");
  const Ran ran = run_gyrocal("replay " + capsule + " --campaign " + looser);
  INFO(ran.out << ran.err);
  CHECK(ran.exit_code == 4);
  CHECK(ran.out.find("DIFFERS in run 1: at ") != std::string::npos);
  CHECK(ran.out.find("the replay decides \"transition: soaking -> logging at ") !=
        std::string::npos);
}

SCENARIO("a CI reads the outcome as JUnit XML, alike and differing") {
  const std::string junit = temporary_file("junit.xml", "");
  const auto text = [&] {
    std::stringstream whole;
    whole << std::ifstream(junit).rdbuf();
    return whole.str();
  };
  REQUIRE(run_gyrocal("replay " + capsule + " --junit " + junit).exit_code == 0);
  CHECK(text().find("<testsuite name=\"gyrocal replay\" tests=\"3\" failures=\"0\">") !=
        std::string::npos);
  const std::string looser = campaign_with("soak_s_min = 300", "soak_s_min = 200");
  CHECK(
      run_gyrocal("replay " + capsule + " --campaign " + looser + " --junit " + junit).exit_code ==
      4);
  CHECK(text().find("failures=\"1\"") != std::string::npos);
  CHECK(text().find("soaking -&gt; logging") != std::string::npos);
  CHECK(text().find("soaking -> logging") == std::string::npos);
}

SCENARIO("a recording that is none, and a window that holds nothing, are refused") {
  const Ran foreign = run_gyrocal("replay " + folder + "outages.toml");
  CHECK(foreign.exit_code == 1);
  CHECK(foreign.err.find("outages.toml: ") != std::string::npos);
  const Ran backwards = run_gyrocal("capsule a.db --from 2:00:00 --to 1:00:00 --out b");
  CHECK(backwards.exit_code == 2);
  CHECK(backwards.err.find("--from 2:00:00 is later than --to 1:00:00") != std::string::npos);
  CHECK(run_gyrocal("replay").exit_code == 2);
  CHECK(std::filesystem::file_size(capsule) < 500'000);
}

}  // namespace gyrocal
