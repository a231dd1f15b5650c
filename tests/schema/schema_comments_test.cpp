// People query this database: what a table, a view or a column means stands in `.schema` itself.
#include <algorithm>
#include <catch2/catch.hpp>

#include "schema/catalogue.h"
#include "schema/sqlite.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("every table, view and column carries a comment", "[schema]") {
  const auto schema = catalogue().value();
  int columns = 0;
  for (const auto& table : schema.tables) {
    CAPTURE(table.name);
    CHECK_FALSE(table.comment.empty());
    for (const auto& column : table.columns) {
      CAPTURE(column.name);
      if (column.name == "id") continue;  // the row's number, everywhere
      CHECK_FALSE(column.comment.empty());
      ++columns;
    }
  }
  CHECK(schema.tables.size() >= 22);
  CHECK(columns > 150);
}

TEST_CASE("a column that a migration added keeps its own comment", "[schema]") {
  const auto schema = catalogue().value();
  const auto model = std::find_if(schema.tables.begin(), schema.tables.end(),
                                  [](const TableInfo& table) { return table.name == "model"; });
  REQUIRE(model != schema.tables.end());
  const auto comment = [&](const std::string& name) {
    for (const auto& column : model->columns) {
      if (column.name == name) return column.comment;
    }
    return std::string("no such column");
  };
  CHECK(comment("dwells_sha256") == "over the raw samples of the dwells used");
  CHECK(comment("warnings") == "sentences, one a line; empty: none");
  CHECK(comment("axis") == "gyro axis");
}

TEST_CASE("foreign keys find their parents by an index", "[schema]") {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "a.db").value(); }
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  auto keys =
      database
          .prepare(
              "SELECT t.name, f.\"from\" FROM sqlite_schema t, pragma_foreign_key_list(t.name) f "
              "WHERE t.type = 'table' AND f.seq = 0")
          .value();
  int checked = 0;
  while (keys.next().value()) {
    CAPTURE(keys.text(0), keys.text(1));
    auto plan = database
                    .prepare("EXPLAIN QUERY PLAN SELECT 1 FROM \"" + keys.text(0) + "\" WHERE \"" +
                             keys.text(1) + "\" = 1")
                    .value();
    REQUIRE(plan.next().value());
    CHECK_THAT(plan.text(3), Catch::StartsWith("SEARCH"));
    ++checked;
  }
  CHECK(checked >= 20);
}
