#include <catch2/catch.hpp>
#include <string>

#include "schema/sqlite.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

/// Rows as the sqlite3 shell prints them: columns by |, rows by newline.
std::string query(const std::string& path, const std::string& sql) {
  const auto database = Database::open(path, OpenMode::read_only).value();
  auto rows = database.prepare(sql).value();
  std::string text;
  while (rows.next().value()) {
    for (int i = 0; i < rows.columns(); ++i) {
      if (i > 0) text += '|';
      text += rows.text(i);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("the views show campaign, samples, drift and models in physical units", "[schema]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  auto store = Store::open(path).value();
  const auto ids = small_campaign::begin(store);
  const auto dwells = small_campaign::log_group(store, ids, 0).value();
  auto disturbed = small_campaign::dwell(ids.first, 1);
  disturbed.reject_reason = "the door was opened";
  disturbed.frames_missing = 2;
  REQUIRE(store.add_group(ids.campaign, std::vector<DwellWithSamples>{{disturbed, {}}}));
  const MonitorInsert row{ids.first, 2'500'000'000, 20, 19.5, 30, {4, 0, 12}, 250, 0};
  REQUIRE(store.add_monitor(ids.campaign, std::vector{row}));
  const std::vector<DwellDriftInsert> drifts{{dwells[0], Axis::z, 4.1, 1.31, 4.11, 0.25, 0.02}};
  ModelInsert model;
  model.board = ids.first;
  model.method = "gm11";
  model.parameters_json = "{}";
  model.rmse_dps = 0.0445;
  model.mae_dps = 0.0384;
  model.loocv_rmse_dps = 0.05;
  REQUIRE(store.add_analysis(ids.campaign, {"{}", "old"}, drifts, std::vector{model}));
  model.rmse_dps = 0.025;
  REQUIRE(store.add_analysis(ids.campaign, {"{}", "new"}, drifts, std::vector{model}));
  REQUIRE(store.add_event(ids.campaign, {9'000'000'000, 0, "info", "transition", "soaking"}));

  CHECK(query(path, "SELECT * FROM campaign_progress") ==
        "1|small|preflight|2023-11-14 22:13:20|2|3|1|2|1|10|2|1000.1\n");
  CHECK(query(path,
              "SELECT campaign, board, axis, setpoint_c, raw_mean_dps, raw_sd_dps, "
              "filtered_mean_dps, filtered_sd_dps FROM zero_drift") ==
        "small|first|z|-10.0|4.1|1.31|4.11|0.25\n");
  CHECK(query(path,
              "SELECT campaign, board, axis, method, rmse_dps, mae_dps, loocv_rmse_dps FROM "
              "model_comparison") == "small|first|z|gm11|0.025|0.0384|0.05\n");
  CHECK(query(path,
              "SELECT board, setpoint_c, seq, t_s, gyro_x_dps, gyro_z_dps, board_c FROM "
              "sample_dps WHERE dwell_id = 1 AND seq = 2") == "first|-10.0|2|0.04|-0.5|2.0|30.0\n");
  CHECK(query(path, "SELECT t_s, gyro_x_dps, gyro_z_dps FROM monitor_dps") == "2.5|1.0|2.0\n");
  CHECK(query(path, "SELECT count(*) FROM gap_history") == "0\n");
}
