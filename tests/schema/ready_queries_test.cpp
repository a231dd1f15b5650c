// Every SQL block of docs/queries.md runs, gives rows, and reaches the large tables by an index.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "config/text_file.h"
#include "schema/sqlite.h"
#include "tests/schema/rig_rows.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

std::vector<std::string> sql_blocks(const std::string& text) {
  const std::string opening("```sql\n");
  std::vector<std::string> blocks;
  for (auto at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    at += opening.size();
    blocks.push_back(text.substr(at, text.find("```", at) - at));
  }
  return blocks;
}

ModelInsert model(BoardId board, const std::vector<DwellId>& dwells) {
  ModelInsert row;
  row.board = board;
  row.method.assign("gm11");
  row.parameters_json.assign("{}");
  row.rmse_dps = 0.0445;
  row.mae_dps = 0.0384;
  row.recommended = true;
  row.reason.assign("smallest error on setpoints it has not seen");
  row.dwells = dwells;
  row.points = {{-10, 4.11, 4.10}, {20, 4.0, 4.02}};
  return row;
}

/// A database with something in every table: two boards, -10 degC visited twice.
void fill(const std::string& path) {
  auto store = Store::open(path).value();
  const std::vector<SetpointRow> points{{0, {-10}}, {1, {20}}, {2, {-10}}};
  const auto campaign = store.begin_campaign(small_campaign::campaign(), points).value();
  const small_campaign::Ids ids{campaign,
                                store.add_board(campaign, small_campaign::board("board0")).value(),
                                store.add_board(campaign, small_campaign::board("board1")).value()};
  std::vector<DwellDriftInsert> drifts;
  std::vector<DwellId> of_first;
  for (int ordinal = 0; ordinal < 3; ++ordinal) {
    const auto dwells = small_campaign::log_group(store, ids, ordinal).value();
    of_first.push_back(dwells.at(0));
    for (const DwellId dwell : dwells) {
      drifts.push_back({dwell, Axis::z, 4.1, 1.31, 4.11 + 0.01 * ordinal, 0.25, 0.02});
    }
  }
  auto rejected = small_campaign::dwell(ids.second, 1, 2);
  rejected.reject_reason = "the door was opened";
  REQUIRE(store.add_group(campaign, std::vector<DwellWithSamples>{{rejected, {}}}));
  const std::vector<ModelInsert> models{model(ids.first, of_first)};
  REQUIRE(store.add_analysis(campaign, {std::string("{}"), std::string("0.1.0")}, drifts, models));
  const std::vector<MonitorInsert> monitor{{ids.first, 5, 20, 20, 20, {1, 2, 3}, 250, 0}};
  REQUIRE(store.add_monitor(campaign, monitor));
  REQUIRE(store.add_event(campaign, {5, 0, "warning", "dwell_rejected", "the door was opened"}));
  const auto before = store.add_rig_model(rig_rows::model("default", "aa")).value();
  REQUIRE(store.add_diagnosis(rig_rows::diagnosis(before, before)));
}

}  // namespace

TEST_CASE("every ready query runs as printed and answers something", "[schema][docs]") {
  const TemporaryFolder folder;
  fill(folder / "a.db");
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  const auto text = read_text_file(GYROCAL_SOURCE_DIR "/docs/queries.md").value();
  const auto blocks = sql_blocks(text);
  CHECK(blocks.size() >= 15);
  for (const auto& sql : blocks) {
    CAPTURE(sql);
    auto statement = database.prepare(sql);
    if (!statement) FAIL(statement.error().what);
    CHECK(statement->next().value());
    auto plan = database.prepare("EXPLAIN QUERY PLAN " + sql).value();
    while (plan.next().value()) {
      CHECK_THAT(plan.text(3),
                 !Catch::StartsWith("SCAN sample") && !Catch::StartsWith("SCAN monitor"));
    }
  }
}
