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
