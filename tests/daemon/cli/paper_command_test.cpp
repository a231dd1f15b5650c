#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

TEST_CASE("gyrocal paper reproduces Table 2 and names the two swapped figures", "[cli]") {
  const auto ran = run_gyrocal("paper --json");
  REQUIRE(ran.exit_code == 0);
  const auto json = nlohmann::json::parse(ran.out);
  REQUIRE(json["rows"].size() == 3);
  int disagreements = 0;
  for (const auto& row : json["rows"]) {
    CHECK(row["rmse"].get<double>() == Approx(row["text_rmse"].get<double>()).margin(5e-5));
    CHECK(row["mae"].get<double>() == Approx(row["text_mae"].get<double>()).margin(5e-5));
    CHECK(row["loocv_rmse"].get<double>() > row["rmse_n"].get<double>());
    disagreements += row["printed_rmse_agrees"] ? 0 : 1;
    disagreements += row["printed_mae_agrees"] ? 0 : 1;
  }
  CHECK(disagreements == 2);
  REQUIRE(json["swapped"].size() == 1);
  CHECK(json["swapped"][0].get<std::string>().starts_with(
      "Table 2 as printed has two figures swapped: 0.0306 stands as the MAE of \"Grey prediction\" "
      "and is the RMSE of \"Least square method\""));
}

TEST_CASE("gyrocal paper as text shows each figure beside the printed one", "[cli]") {
  const auto ran = run_gyrocal("paper");
  CHECK(ran.exit_code == 0);
  CHECK(ran.out.find("Grey prediction              0.0445   0.0384     0.0445   0.0306!") !=
        std::string::npos);
  CHECK(ran.out.find("Improved grey prediction     0.0250   0.0180     0.0250   0.0180 ") !=
        std::string::npos);
}

TEST_CASE("level 5 is the one that leaves what the paper reports of a dwell's deviation", "[cli]") {
  for (const char* seed : {"1", "2", "3"}) {
    CAPTURE(seed);
    const auto ran = run_gyrocal(std::string("paper --dwell-deviation --json --seed ") + seed);
    REQUIRE(ran.exit_code == 0);
    const auto json = nlohmann::json::parse(ran.out);
    CHECK(json["nearest_level"] == 5);
    const auto& level_5 = json["levels"][4];
    CHECK(level_5["raw_dps"].get<double>() == Approx(1.3102).epsilon(0.015));
    CHECK(level_5["filtered_dps"].get<double>() == Approx(0.2488).epsilon(0.1));
    CHECK(level_5["lowest_dps"] < 0.2488);
    CHECK(level_5["highest_dps"] > 0.2488);
  }
  CHECK(run_gyrocal("paper --seed 2").exit_code == 2);  // a seed of nothing
}

TEST_CASE("Table 1 as CSV is what fit reads", "[cli]") {
  const auto table = run_gyrocal("paper --table-1");
  REQUIRE(table.exit_code == 0);
  const auto fitted = run_gyrocal("fit --table - --json", table.out);
  REQUIRE(fitted.exit_code == 0);
  CHECK(nlohmann::json::parse(fitted.out)["models"][1]["rmse_n"].get<double>() ==
        Approx(0.024459333698011676).epsilon(1e-9));
}

TEST_CASE("the paper examined: degree 5 alone gives its figures", "[cli]") {
  const auto ran = run_gyrocal("paper --examine");
  CHECK(ran.exit_code == 0);
  CHECK(ran.out.find("improved_gm11, degree 5             0.0250    0.0180") != std::string::npos);
  CHECK(ran.out.find("1.3102 / sqrt(3000) = 0.0239 deg/s") != std::string::npos);
  CHECK(ran.out.find("= 4.133 LSB/(deg/s)") != std::string::npos);
  CHECK(run_gyrocal("paper --examine --table-1").exit_code == 2);
}
