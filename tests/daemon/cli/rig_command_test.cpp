#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/rig_model.h"
#include "schema/session/session_csv.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

std::string session_folder(const std::string& name) {
  return std::filesystem::path(temporary_file(name + ".anchor", "")).replace_extension("").string();
}

}  // namespace

TEST_CASE("gyrocal rig simulate writes a session that reads back", "[cli]") {
  const std::string folder = session_folder("simulated");
  const auto ran = run_gyrocal("rig simulate --out " + folder +
                               " --setpoints -10,0,10 --soak 300 --samples 200 --rate 25 --axis x "
                               "--noise 0.1 --lsb 0.05 --json");
  REQUIRE(ran.exit_code == 0);
  CHECK(nlohmann::json::parse(ran.out)["samples"] == 600);
  const auto session = read_session(folder);
  REQUIRE(session);
  CHECK(session->axis == "x");
  CHECK(session->lsb_dps == 0.05);
  CHECK(session->samples.size() == 600);
}

TEST_CASE("gyrocal rig simulate gives the same bytes for the same seed", "[cli]") {
  const auto made = [](const std::string& name, int seed) {
    const std::string folder = session_folder(name);
    const auto ran =
        run_gyrocal("rig simulate --out " + folder +
                    " --setpoints 20,25 --soak 60 --samples 100 --seed " + std::to_string(seed));
    REQUIRE(ran.exit_code == 0);
    return read_session(folder)->samples;
  };
  const auto first = made("first", 4), again = made("again", 4), other = made("other", 5);
  REQUIRE(first.size() == 200);
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].gyro_dps == again[i].gyro_dps);
    differs = differs || first[i].gyro_dps != other[i].gyro_dps;
  }
  CHECK(differs);
}

TEST_CASE("gyrocal rig simulate refuses what cannot be run", "[cli]") {
  for (const std::string wrong : {"--soak nan", "--plan sideways", "--setpoints 900", "--noise -1",
                                  "--rate 0", "--rig-model no_such_model", "--samples 0"}) {
    CAPTURE(wrong);
    const auto ran = run_gyrocal("rig simulate --out /nonexistent/x " + wrong);
    CHECK(ran.exit_code == 2);
    CHECK_FALSE(ran.err.empty());
  }
}

TEST_CASE("a rig model with a mistake is refused with file and line", "[cli]") {
  const std::string file = temporary_file("wrong.json",
                                          "{\"format\": \"gyrocal-rig-model/1\", \"name\": "
                                          "\"m\",\n\"effects\": [{\"effect\": \"x\"}]}");
  const auto ran = run_gyrocal("rig show " + file);
  CHECK(ran.exit_code == 2);
  CHECK(ran.err.find(file + ":2: /effects/0/effect: unknown effect \"x\"") != std::string::npos);
}

TEST_CASE("a mistyped model or effect gets the nearest one", "[cli]") {
  const auto advised = [](const std::string& words, const std::string& name) {
    CAPTURE(words);
    const auto ran = run_gyrocal(words);
    CHECK(ran.exit_code == 2);
    CHECK(ran.err.find("is \"" + name + "\" meant?") != std::string::npos);
  };
  advised("rig show quite_hysteresis", "quiet_hysteresis");
  advised("rig show termal_lag", "thermal_lag");
  advised("rig diff quiet quiet_hysteresi", "quiet_hysteresis");
  advised("rig simulate --out /nonexistent/x --rig-model qiuet", "quiet");
}

TEST_CASE("gyrocal rig shows models, effects and differences", "[cli]") {
  const auto models = nlohmann::json::parse(run_gyrocal("rig models --json").out);
  REQUIRE(models.size() >= 3);
  const auto shown = run_gyrocal("rig show quiet --json");
  CHECK(parse_rig_model(shown.out, "stdout") == read_rig_model("quiet"));
  CHECK(nlohmann::json::parse(run_gyrocal("rig show --catalogue --json").out).size() == 22);
  CHECK(run_gyrocal("rig diff quiet quiet").out == "the two simulate alike\n");
  CHECK(run_gyrocal("rig diff quiet quiet_hysteresis").out ==
        "+ effect thermal_hysteresis, play: h = 0.02 dps, w = 2.5 degC\n");
}
