#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/daemon/cli/run_gyrocal.h"

namespace gyrocal {
namespace {

const std::string demo = std::string(GYROCAL_SOURCE_DIR) + "/config/campaigns/demo.toml";

}  // namespace

SCENARIO("a campaign in virtual time prints its table and its database") {
  const std::string database = temporary_file("virtual.db", "");
  const Ran ran = run_gyrocal("run " + demo + " --virtual --seed 3 --db " + database);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out.find("Board board1") != std::string::npos);
  CHECK(ran.out.find("improved GM(1,1)") != std::string::npos);
  CHECK(ran.out.find("Stored in " + database) != std::string::npos);
  CHECK(ran.err.find("analysing -> finished") != std::string::npos);
  CHECK(ran.err.find('\r') == std::string::npos);  // no progress bar without a terminal
}

SCENARIO("a plan says what it would show, and writes a campaign that tells more apart") {
  const std::string campaign = temporary_file(
      "one_way.toml",
      "[campaign]\nname = \"one_way\"\nsimulated = true\n[plan]\nsetpoints_c = [-10, 5, 20, 35, "
      "50]\n[chamber]\nprofile = \"yinhe\"\nhost = \"127.0.0.1\"\n[[board]]\nname = \"a\"\n"
      "device = \"/dev/a\"\n");
  const std::string apart = temporary_file("one_way_apart.toml", "");
  const Ran ran = run_gyrocal("plan --json " + campaign + " --write " + apart);
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["format"] == "gyrocal-plan/1");
  CHECK(json["dwells"] == 5);
  CHECK(json["detection_limits"]["bias_jump"]["unit"] == "dps");
  const auto open = [](const nlohmann::json& plan) {
    int count = 0;
    for (const auto& pair : plan["pairs"]) count += pair["told_apart"].get<bool>() ? 0 : 1;
    return count;
  };
  const auto better = nlohmann::json::parse(run_gyrocal("plan --json " + apart).out);
  CHECK(better["dwells"] > 5);
  CHECK(open(better) < open(json));
  const Ran text = run_gyrocal("plan " + campaign);
  CHECK(text.out.find("Pairs this plan hardly tells apart") != std::string::npos);
}

SCENARIO("usage and campaign files that are wrong exit with 2 and say where") {
  CHECK(run_gyrocal("run").exit_code == 2);
  CHECK(run_gyrocal("run " + demo + " --seed 3").exit_code == 2);  // needs --virtual
  const Ran absent = run_gyrocal("run /nowhere/campaign.toml");
  CHECK(absent.exit_code == 2);
  CHECK(absent.err.find("/nowhere/campaign.toml") != std::string::npos);
  const std::string bad = temporary_file("bad.toml", "[campaign]\nname = \"x\"\nnmae = 1\n");
  const Ran unknown = run_gyrocal("check " + bad);
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("nmae") != std::string::npos);
}

SCENARIO("check without a chamber fails, tells what and where, and prints the plan all the same") {
  const Ran ran = run_gyrocal("check " + demo + " --json");
  CHECK(ran.exit_code == 1);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK_FALSE(json["passed"].get<bool>());
  CHECK(json["setpoints_c"].size() == 25);
  CHECK(json["samples"] == 150000);
  CHECK(json["devices"].size() == 3);
  CHECK(json["devices"][0]["error"].get<std::string>().find("127.0.0.1:15020") !=
        std::string::npos);
  CHECK(ran.err.find("advice") != std::string::npos);
}

SCENARIO("asking after a campaign that does not run says so") {
  for (const char* command : {"status", "pause", "resume", "skip", "abort"}) {
    const Ran ran = run_gyrocal(std::string(command) + " no-such-campaign");
    CHECK(ran.exit_code == 1);
    CHECK(ran.err.find("no-such-campaign") != std::string::npos);
  }
}

}  // namespace gyrocal
