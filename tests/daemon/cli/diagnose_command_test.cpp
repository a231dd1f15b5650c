#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/text_file.h"
#include "schema/sqlite.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;
using nlohmann::json;

namespace {

std::string path_of(const std::string& name) { return temporary_file(name, ""); }

/// A database with one campaign of a rig that has a hysteresis the default rig model lacks.
std::string campaign_with_hysteresis(const std::string& name) {
  const std::string folder = path_of(name + ".session");
  std::filesystem::remove(folder);
  const auto made = run_gyrocal("rig simulate --out " + folder +
                                " --rig-model quiet_hysteresis --plan up_down --samples 1000"
                                " --noise 0.1 --lsb 0.05 --seed 3");
  REQUIRE(made.exit_code == 0);
  const std::string database = path_of(name + ".db");
  std::filesystem::remove(database);
  REQUIRE(run_gyrocal("import " + folder + " --db " + database).exit_code == 0);
  return database;
}

/// A campaign of two boards in one chamber whose air is moist, and board axes alike in nothing
/// else.
std::string campaign_in_moist_air(const std::string& name) {
  json rig = json::parse(*read_text_file(GYROCAL_SOURCE_DIR "/config/rig_models/quiet.json"));
  rig["name"] = "moist";
  rig["effects"] = {
      {{"effect", "condensation_step"},
       {"law", "film"},
       {"parameters", {{"a", 0.06}, {"t_dew", 4}, {"tau_on", 120}, {"tau_off", 1800}}},
       {"axes", "xyz"}}};
  const std::string model = temporary_file("moist.json", rig.dump());
  std::string plan = *read_text_file(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml");
  const std::string long_dwells = "samples_per_setpoint = 3000";
  plan.replace(plan.find(long_dwells), long_dwells.size(), "samples_per_setpoint = 600");
  const std::string database = path_of(name + ".db");
  std::filesystem::remove(database);
  const auto ran = run_gyrocal("run " + temporary_file("moist.toml", plan) +
                               " --virtual --seed 5 --rig-model " + model + " --db " + database);
  REQUIRE(ran.exit_code == 0);
  return database;
}

}  // namespace

TEST_CASE("a diagnosis of a database is kept there, and the better model leaves nothing to say",
          "[cli]") {
  const std::string database = campaign_with_hysteresis("diagnosed");
  const std::string better = path_of("better.json");
  const auto first =
      run_gyrocal("diagnose --db " + database + " --json --write-rig-model " + better);
  REQUIRE(first.exit_code == 0);
  const json found = json::parse(first.out);
  CHECK(found["verdict"] == "explained");
  REQUIRE(found["findings"].size() == 1);
  CHECK(found["findings"][0]["effect"] == "thermal_hysteresis");

  const auto second =
      run_gyrocal("diagnose --db " + database + " --json --exit-code --rig-model " + better);
  CHECK(second.exit_code == 0);
  CHECK(json::parse(second.out)["verdict"] == "consistent");

  const auto stored = Database::open(database, OpenMode::read_only).value();
  auto steps =
      stored.prepare("SELECT effect_added, gap_before, gap_after FROM gap_history").value();
  REQUIRE(steps.next().value());
  CHECK(steps.text(0) == "thermal_hysteresis");
  CHECK(steps.real(1) == Approx(found["gap"]["before"].get<double>()));
  CHECK(steps.real(2) < steps.real(1));
  REQUIRE(steps.next().value());
  CHECK(steps.is_null(0));
  CHECK_FALSE(steps.next().value());
}

TEST_CASE("--all tells for each effect who shows it", "[cli]") {
  const std::string database = campaign_with_hysteresis("shared");
  const auto ran = run_gyrocal("diagnose --db " + database + " --all --jobs 2 --json");
  REQUIRE(ran.exit_code == 0);
  const json all = json::parse(ran.out);
  CHECK(all["format"] == "gyrocal-diagnosis-all/1");
  REQUIRE(all["diagnoses"].size() == 1);
  CHECK(all["diagnoses"][0]["diagnosis"]["verdict"] == "explained");
  REQUIRE(all["shared"].size() == 1);
  CHECK(all["shared"][0]["effect"] == "thermal_hysteresis");
  CHECK(all["shared"][0]["origin"] == "unclear");  // one board tells nothing of the room
}

TEST_CASE("--all finds that moist air is common to both boards of a campaign", "[cli]") {
  const std::string database = campaign_in_moist_air("moist");
  const auto ran = run_gyrocal("diagnose --db " + database + " --all --jobs 2 --json");
  REQUIRE(ran.exit_code == 0);
  const json all = json::parse(ran.out);
  CAPTURE(all["shared"].dump());
  REQUIRE(all["diagnoses"].size() == 6);
  REQUIRE_FALSE(all["shared"].empty());
  CHECK(all["shared"][0]["effect"] == "condensation_step");
  CHECK(all["shared"][0]["origin"] == "environment");
  CHECK(all["shared"][0]["seen_in"].size() >= 5);
}
