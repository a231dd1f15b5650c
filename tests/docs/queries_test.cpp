// The ready queries of docs/queries.md on a whole campaign: 25 setpoints up and 24 down, two
// simulated boards, one diagnosis. Not "no error": what they answer is what is known of it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "config/text_file.h"
#include "schema/sqlite.h"
#include "tests/daemon/cli/run_gyrocal.h"

using namespace gyrocal;

namespace {

struct Table {
  std::vector<std::map<std::string, Cell>> rows;
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    const Cell& cell = rows.at(row).at(column);
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
    return std::get<double>(cell);
  }
  [[nodiscard]] std::string text(std::size_t row, const std::string& column) const {
    return std::get<std::string>(rows.at(row).at(column));
  }
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  REQUIRE(text.find(what) != std::string::npos);
  return text.replace(text.find(what), what.size(), by);
}

/// The campaign's database, made once.
const std::string& campaign_database() {
  static const std::string path = [] {
    auto toml = read_text_file(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml").value();
    toml = replaced(toml, "sweep = \"up\"", "sweep = \"up_down\"");
    toml = replaced(toml, "samples_per_setpoint = 3000", "samples_per_setpoint = 1000");
    const auto campaign = temporary_file("up_down.toml", toml);
    auto database = campaign + ".db";
    const auto ran = run_gyrocal("run " + campaign + " --virtual --seed 7 --db " + database);
    INFO(ran.err);
    REQUIRE(ran.exit_code == 0);
    REQUIRE(run_gyrocal("diagnose --db " + database + " --board board0 --axis z").exit_code == 0);
    return database;
  }();
  return path;
}

/// Rows of the one query of the page that contains `part`.
Table answer(const std::string& part) {
  const auto page = read_text_file(GYROCAL_SOURCE_DIR "/docs/queries.md").value();
  const auto at = page.find(part);
  CAPTURE(part);
  REQUIRE(at != std::string::npos);
  const std::string fence("```sql\n");
  const auto begin = page.rfind(fence, at) + fence.size();
  const auto sql = page.substr(begin, page.find("```", begin) - begin);
  REQUIRE(sql.find(part) != std::string::npos);
  const auto database = Database::open(campaign_database(), OpenMode::read_only).value();
  auto statement = database.prepare(sql).value();
  Table table;
  while (statement.next().value()) {
    auto& row = table.rows.emplace_back();
    for (int i = 0; i < statement.columns(); ++i) {
      row[statement.column_name(i)] = statement.cell(i);
    }
  }
  return table;
}

}  // namespace

TEST_CASE("where it stands: finished, 49 setpoints, nothing lost, nothing thrown away",
          "[docs][queries]") {
  for (const auto* part : {"frames_missing FROM campaign_progress", "AS hours"}) {
    const auto progress = answer(part);
    REQUIRE(progress.rows.size() == 1);
    CHECK(progress.text(0, "state") == "finished");
    CHECK(progress.number(0, "setpoints_logged") == 49);
    CHECK(progress.number(0, "samples") == 2 * 49 * 1000);
    CHECK(progress.number(0, "frames_missing") == 0);
  }
  CHECK(answer("AS hours").number(0, "hours") > 49 * 0.15);
  CHECK(answer("severity <> 'info'").rows.empty());
  CHECK(answer("attempt, reject_reason").rows.empty());
}

TEST_CASE("each setpoint soaked its seven minutes in steady air", "[docs][queries]") {
  const auto soaks = answer("AS soak_min");
  REQUIRE(soaks.rows.size() == 49);
  for (std::size_t i = 0; i < 49; ++i) {
    CHECK(soaks.number(i, "soak_min") >= 7);
    CHECK(soaks.number(i, "soak_min") <= 60);
    CHECK(soaks.number(i, "air_peak_to_peak_k") < 1);
  }
  const auto losses = answer("AS missing");
  REQUIRE(losses.rows.size() == 2);
  CHECK(losses.number(1, "samples") == 49 * 1000);
  CHECK(losses.number(1, "missing") == 0);
}

TEST_CASE("the filter keeps the drift and takes most of the deviation", "[docs][queries]") {
  const auto drift = answer("standard_error_dps, 4) AS error_dps");
  REQUIRE(drift.rows.size() == 49);
  for (std::size_t i = 0; i < 49; ++i) {
    CHECK(std::abs(drift.number(i, "raw_dps") - drift.number(i, "drift_dps")) < 0.02);
    CHECK(drift.number(i, "error_dps") > 0);
    CHECK(drift.number(i, "error_dps") < 0.2);
  }
  CHECK(answer("AS zero_drift_dps").rows.size() == 49);
  const auto filtered = answer("avg(raw_sd_dps)");
  REQUIRE(filtered.rows.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(filtered.number(i, "filtered_sd_dps") < 0.3 * filtered.number(i, "raw_sd_dps"));
  }
}

TEST_CASE("span, revisits and differences of boards agree with the drift", "[docs][queries]") {
  const auto span = answer("AS span_dps");
  REQUIRE(span.rows.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(span.number(i, "span_dps") ==
          Approx(span.number(i, "highest_dps") - span.number(i, "lowest_dps")).margin(2e-4));
    CHECK(span.number(i, "span_dps") > 0.05);
  }
  const auto revisits = answer("ORDER BY abs(again.filtered_mean_dps");
  REQUIRE(revisits.rows.size() == 2 * 3 * 24);  // all but the turning point, twice
  CHECK(std::abs(revisits.number(0, "difference_dps")) >=
        std::abs(revisits.number(143, "difference_dps")));
  CHECK(std::abs(revisits.number(0, "difference_dps")) < 0.3);  // noise: no hysteresis is simulated
  CHECK(answer("AS a\n").rows.size() == 3 * 49);
}

TEST_CASE("models: nine a board and axis, the recommended predicts unseen setpoints best",
          "[docs][queries]") {
  const auto models = answer("ORDER BY board, loocv_rmse_dps");
  REQUIRE(models.rows.size() == 18);
  CHECK(models.number(0, "recommended") == 1);
  CHECK(models.number(9, "recommended") == 1);
  const auto one = answer("AS unseen_rmse_dps");
  REQUIRE(one.rows.size() == 9);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(one.number(i, "mae_dps") <= one.number(i, "rmse_dps"));
    CHECK(one.number(i, "unseen_rmse_dps") > one.number(i, "rmse_dps"));
  }
  const auto why = answer("axis, method, reason");
  REQUIRE(why.rows.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK_THAT(why.text(i, "reason"), Catch::Contains(why.text(i, "method")));
  }
  const auto misses = answer("AS residual_dps");
  REQUIRE(misses.rows.size() == 10);
  CHECK(std::abs(misses.number(0, "residual_dps")) >= std::abs(misses.number(9, "residual_dps")));
  const auto provenance = answer("settings_json, software_version");
  REQUIRE(provenance.rows.size() == 54);
  std::set<std::string> hashes;
  for (std::size_t i = 0; i < 54; ++i) {
    CHECK(provenance.number(i, "dwells") == 49);
    hashes.insert(provenance.text(i, "dwells_sha256"));
  }
  CHECK(hashes.size() == 2);  // a board's: the dwells of all axes together
}

TEST_CASE("samples and the slow stream come in degrees per second", "[docs][queries]") {
  const auto samples = answer("FROM sample_dps");
  REQUIRE(samples.rows.size() == 5);
  CHECK(samples.number(4, "seq") == 4);
  CHECK(samples.number(4, "t_s") - samples.number(0, "t_s") == Approx(4 / 50.0).margin(0.01));
  const auto counts = answer("GROUP BY gyro_z_lsb");
  double total = 0;
  for (std::size_t i = 0; i < counts.rows.size(); ++i) total += counts.number(i, "samples");
  CHECK(total == 1000);
  const auto hour = answer("FROM monitor_dps");
  CHECK(hour.rows.size() > 650);  // one in 5 s
  CHECK(hour.number(hour.rows.size() - 1, "t_s") < 3600);
}

TEST_CASE("a session without a hidden effect shows one step that adds nothing", "[docs][queries]") {
  const auto gap = answer("FROM gap_history");
  REQUIRE(gap.rows.size() == 1);
  CHECK(std::holds_alternative<std::monostate>(gap.rows[0].at("effect_added")));
  CHECK(gap.number(0, "gap_after") < 1);
}

TEST_CASE("a table as CSV carries the units in its column names", "[docs]") {
  const auto csv = run_gyrocal("export --db " + campaign_database() + " --table zero_drift");
  REQUIRE(csv.exit_code == 0);
  CHECK_THAT(csv.out,
             Catch::StartsWith("campaign_id,campaign,board,axis,ordinal,setpoint_c,chamber_mean_c,"
                               "board_mean_c,raw_mean_dps,raw_sd_dps,filtered_mean_dps,"
                               "filtered_sd_dps,standard_error_dps\n1,demo,board0,x,0,-10,"));
  CHECK(std::count(csv.out.begin(), csv.out.end(), '\n') == 1 + 2 * 3 * 49);
}
