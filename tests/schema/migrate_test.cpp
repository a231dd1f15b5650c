#include "schema/migrate.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

std::vector<SqlFile> with_next_version(const SqlFile& next) {
  std::vector<SqlFile> files(embedded_migrations().begin(), embedded_migrations().end());
  files.push_back(next);
  return files;
}

}  // namespace

TEST_CASE("a new database has the application's id and the newest version", "[schema]") {
  const TemporaryFolder folder;
  { auto store = Store::open(folder / "a.db").value(); }
  const auto database = Database::open(folder / "a.db", OpenMode::read_only).value();
  CHECK(database.integer("PRAGMA application_id").value() == 0x47595243);
  CHECK(database.integer("PRAGMA user_version").value() == newest_version(embedded_migrations()));
}

TEST_CASE("an old database is migrated with all it holds, and a copy is kept", "[schema]") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  {
    auto store = Store::open(path).value();
    const auto ids = small_campaign::begin(store);
    REQUIRE(small_campaign::log_group(store, ids, 0).has_value());
  }
  const auto before = dump(path);
  const auto database = Database::open(path, OpenMode::read_write_create).value();
  const auto next = with_next_version({"002_next.sql", "CREATE TABLE next_table(a) STRICT"});
  const std::vector<SqlFile> no_views;

  SECTION("whole") {
    const auto valid =
        with_next_version({"002_next.sql", "CREATE TABLE next_table(a INTEGER) STRICT"});
    CHECK(migrate(database, valid, embedded_views()).value());
    CHECK(database.integer("PRAGMA user_version").value() == 2);
    CHECK(dump(path) == before);
    CHECK(dump(path + ".schema-1") == before);
    CHECK_FALSE(migrate(database, valid, embedded_views()).value());  // nothing left to do
  }
  SECTION("or not at all") {
    CHECK_FALSE(migrate(database, next, no_views).has_value());  // STRICT wants a type
    CHECK(database.integer("PRAGMA user_version").value() == 1);
    CHECK(database.integer("SELECT count(*) FROM sqlite_schema WHERE type = 'view'").value() > 4);
    CHECK(dump(path) == before);
  }
}
