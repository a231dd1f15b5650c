#include "schema/maintenance.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "schema/migrate.h"
#include "schema/sqlite.h"
#include "schema/table_reader.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

TEST_CASE("a sound database has no problems, a tampered one has them named", "[schema]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  {
    auto store = Store::open(path).value();
    const auto ids = small_campaign::begin(store);
    const auto dwells = small_campaign::log_group(store, ids, 0).value();
    ModelInsert model;
    model.board = ids.first;
    model.method = "gm11";
    model.parameters_json = std::string("{}");
    model.dwells = {dwells[0]};
    REQUIRE(store.add_analysis(ids.campaign, {"{}", "0.1.0"}, {}, std::vector{model}));
  }
  CHECK(problems_in_database(path).value().empty());
  const auto tamper = [&path](const char* sql) {
    REQUIRE(Database::open(path, OpenMode::read_write_create).value().execute(sql));
  };
  std::string expected;
  SECTION("samples deleted") {
    tamper("DELETE FROM sample WHERE dwell_id = 1 AND seq = 2");
    expected = "dwell 1 counts 5 samples, 4 are stored";
  }
  SECTION("a model's dwell rejected afterwards") {
    tamper("UPDATE dwell SET reject_reason = 'door' WHERE id = 1");
    expected = "model 1 was fitted to dwell 1, which is rejected";
  }
  SECTION("a parent deleted with foreign keys off") {
    tamper("DELETE FROM campaign");
    expected = "board row 1 refers to a row of campaign that is not there";
  }
  SECTION("an index that lost its rows") {
    tamper(
        "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, "
        "'IS NULL', 'IS NOT NULL') WHERE name = 'dwell_accepted'");
    expected = "wrong # of entries in index dwell_accepted";
  }
  const auto problems = problems_in_database(path).value();
  CHECK_THAT(problems, Catch::VectorContains(expected));
}

TEST_CASE("a backup taken while a campaign writes holds what was stored", "[schema]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  const auto ids = small_campaign::begin(store);
  REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
  REQUIRE(backup_database(folder / "a.db", folder / "b.db"));
  CHECK(dump(folder / "b.db") == dump(folder / "a.db"));
  CHECK(problems_in_database(folder / "b.db").value().empty());
  CHECK_FALSE(std::filesystem::exists(folder / "b.db-wal"));  // one file

  REQUIRE(small_campaign::log_group(store, ids, 1).has_value());
  const auto again = backup_database(folder / "a.db", folder / "b.db");
  REQUIRE_FALSE(again.has_value());  // an older backup is never replaced
  CHECK(again.error().code == Errc::busy);
  CHECK(dump(folder / "b.db") != dump(folder / "a.db"));
  CHECK_FALSE(backup_database(folder / "a.db", "/nowhere/b.db").has_value());
  CHECK_FALSE(backup_database(folder / "none.db", folder / "c.db").has_value());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    files += entry.path().string().find("unfinished") != std::string::npos ? 1 : 0;
  }
  CHECK(files == 0);
}

TEST_CASE("migrating what is up to date does nothing, and never creates a file", "[schema]") {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "a.db").value(); }
  const auto migrated = migrate_database(folder / "a.db").value();
  CHECK(migrated.from == newest_version(embedded_migrations()));
  CHECK(migrated.to == migrated.from);
  CHECK_FALSE(migrated.copy.has_value());
  CHECK_FALSE(migrate_database(folder / "none.db").has_value());
  CHECK_FALSE(std::filesystem::exists(folder / "none.db"));
}

TEST_CASE("any table or view is read with its columns; a mistyped one gets the nearest",
          "[schema]") {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "a.db").value();
  small_campaign::begin(store);
  auto reader = TableReader::open(folder / "a.db", "setpoint").value();
  CHECK(reader.columns() == std::vector<std::string>{"campaign_id", "ordinal", "setpoint_c"});
  std::vector<Cell> row;
  REQUIRE(reader.next(row).value());
  CHECK(row == std::vector<Cell>{std::int64_t{1}, std::int64_t{0}, -10.0});
  const auto mistyped = TableReader::open(folder / "a.db", "zero_drfit");
  REQUIRE_FALSE(mistyped.has_value());
  CHECK(mistyped.error().what == folder / "a.db" + ": no table or view \"zero_drfit\"");
  CHECK_THAT(mistyped.error().advice, Catch::StartsWith("is \"zero_drift\" meant? there are: "));
}
