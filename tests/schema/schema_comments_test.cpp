// People query this database: what a table, a view or a column means stands in `.schema` itself.
#include <catch2/catch.hpp>
#include <regex>
#include <sstream>

#include "schema/sqlite.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("every table, view and column carries a comment", "[schema]") {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "a.db").value(); }
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  auto things =
      database.prepare("SELECT name, sql FROM sqlite_schema WHERE type IN ('table', 'view')")
          .value();
  int tables = 0;
  int columns = 0;
  while (things.next().value()) {
    CAPTURE(things.text(0));
    std::istringstream sql(things.text(1));
    std::string line;
    REQUIRE(std::getline(sql, line));
    CHECK_THAT(line, Catch::Contains("  -- "));
    ++tables;
    auto names = database.prepare("SELECT name FROM pragma_table_info(?)").value();
    names.bind(0, things.text(0));
    while (names.next().value()) {
      const auto name = names.text(0);
      if (name == "id") continue;  // the row's number, everywhere
      CAPTURE(name);
      const std::regex commented("\\b" + name + "\\b[^\\n]*  -- \\S[^\\n]*(\\n|$)");
      CHECK(std::regex_search(things.text(1), commented));
      ++columns;
    }
  }
  CHECK(tables >= 22);
  CHECK(columns > 150);
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
