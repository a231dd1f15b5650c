// An analyst's scripts outlive a schema: files of every earlier version open, and the views keep
// their columns.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "config/text_file.h"
#include "schema/catalogue.h"
#include "schema/maintenance.h"
#include "schema/migrate.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

/// A file as the program of that schema left it (tests/schema/old).
void make_old(const std::string& path, int version) {
  const auto sql =
      read_text_file(fmt::format(GYROCAL_SOURCE_DIR "/tests/schema/old/schema_{}.sql", version));
  if (!sql) FAIL("no file of schema " << version << " is kept: " << sql.error().what);
  const auto database = Database::open(path, OpenMode::read_write_create).value();
  REQUIRE(database.execute(*sql));
}

}  // namespace

TEST_CASE("a database of every earlier schema migrates with all it holds, a copy kept",
          "[schema]") {
  const int newest = newest_version(embedded_migrations());
  for (int version = 1; version < newest; ++version) {
    CAPTURE(version);
    const TemporaryFolder folder;
    const std::string path = folder / "old.db";
    make_old(path, version);
    const auto as_it_was = dump(path);
    const auto migrated = migrate_database(path).value();
    CHECK(migrated.from == version);
    CHECK(migrated.to == newest);
    REQUIRE(migrated.copy == fmt::format("{}.schema-{}", path, version));
    CHECK(dump(*migrated.copy) == as_it_was);
    CHECK(problems_in_database(path).value().empty());

    const auto database = Database::open(path, OpenMode::read_only).value();
    CHECK(database.integer("SELECT count(*) FROM zero_drift WHERE axis = 'z'").value() == 25);
    CHECK(database
              .integer("SELECT round(1e4 * rmse_dps) FROM model_comparison WHERE method = "
                       "'least_squares'")
              .value() == 207);
    CHECK(database.integer("SELECT count(*) FROM sample_dps").value() == 50);
    CHECK(database.integer("SELECT setpoints_logged FROM campaign_progress").value() == 25);
  }
}

TEST_CASE("the views keep their names, columns and order; new columns come at the end",
          "[schema]") {
  // What scripts may rely on. Lines grow at their ends only.
  const std::vector<std::pair<std::string, std::vector<std::string>>> promised{
      {"campaign_progress",
       {"campaign_id", "campaign", "state", "utc_start", "boards", "setpoints", "setpoints_logged",
        "dwells_accepted", "dwells_rejected", "samples", "frames_missing", "t_last_s"}},
      {"gap_history",
       {"diagnosis_id", "source", "axis", "rig_model_before", "rig_model_after", "step",
        "effect_added", "gap_before", "gap_after"}},
      {"model_comparison",
       {"campaign_id", "campaign", "board", "axis", "method", "rmse_dps", "mae_dps",
        "loocv_rmse_dps", "rmse_n_minus_1_dps", "max_dps", "recommended", "block_rmse_dps",
        "warnings"}},
      {"monitor_dps",
       {"campaign_id", "board", "t_s", "setpoint_c", "chamber_c", "board_c", "gyro_x_dps",
        "gyro_y_dps", "gyro_z_dps", "frames", "frames_missing"}},
      {"sample_dps",
       {"campaign_id", "board", "dwell_id", "setpoint_c", "reject_reason", "seq", "t_s",
        "gyro_x_dps", "gyro_y_dps", "gyro_z_dps", "board_c"}},
      {"zero_drift",
       {"campaign_id", "campaign", "board", "axis", "ordinal", "setpoint_c", "chamber_mean_c",
        "board_mean_c", "raw_mean_dps", "raw_sd_dps", "filtered_mean_dps", "filtered_sd_dps",
        "standard_error_dps"}}};
  std::map<std::string, std::vector<std::string>> present;
  const auto schema = catalogue().value();
  for (const auto& table : schema.tables) {
    for (const auto& column : table.columns) present[table.name].push_back(column.name);
  }
  for (const auto& [view, columns] : promised) {
    CAPTURE(view);
    auto& now = present[view];
    REQUIRE(now.size() >= columns.size());
    now.resize(columns.size());
    CHECK(now == columns);
  }
}
