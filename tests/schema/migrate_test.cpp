#include "schema/migrate.h"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <vector>

#include "schema/maintenance.h"
#include "tests/schema/small_campaign.h"
#include "tests/schema/temporary_folder.h"

using namespace gyrocal;

namespace {

const int newest = newest_version(embedded_migrations());

std::vector<SqlFile> with_next_version(const char* sql) {
  static const std::string name = fmt::format("{:03}_next.sql", newest + 1);
  std::vector<SqlFile> files(embedded_migrations().begin(), embedded_migrations().end());
  files.push_back({name, sql});
  return files;
}

/// Those that made the first version of the schema.
std::vector<SqlFile> first_migrations() {
  std::vector<SqlFile> files(embedded_migrations().begin(), embedded_migrations().end());
  std::erase_if(files, [](const SqlFile& file) { return !file.name.starts_with("001"); });
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
  const auto next = with_next_version("CREATE TABLE next_table(a) STRICT");
  const std::vector<SqlFile> no_views;

  SECTION("whole") {
    const auto valid = with_next_version("CREATE TABLE next_table(a INTEGER) STRICT");
    CHECK(migrate(database, valid, embedded_views()).value());
    CHECK(database.integer("PRAGMA user_version").value() == newest + 1);
    CHECK(dump(path) == before);
    CHECK(dump(fmt::format("{}.schema-{}", path, newest)) == before);
    CHECK_FALSE(migrate(database, valid, embedded_views()).value());  // nothing left to do
  }
  SECTION("or not at all") {
    CHECK_FALSE(migrate(database, next, no_views).has_value());  // STRICT wants a type
    CHECK(database.integer("PRAGMA user_version").value() == newest);
    CHECK(database.integer("SELECT count(*) FROM sqlite_schema WHERE type = 'view'").value() > 4);
    CHECK(dump(path) == before);
  }
}

TEST_CASE("a model of the first schema is read with its later columns unknown", "[schema]") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.db";
  {
    const auto database = Database::open(path, OpenMode::read_write_create).value();
    REQUIRE(migrate(database, first_migrations(), {}).value());
    REQUIRE(
        database
            .execute("INSERT INTO campaign VALUES (1, 'old', '', '0.1.0', 0, 1, 1, 5, 50, 5, "
                     "'finished');"
                     "INSERT INTO board VALUES (1, 1, 'first', '', '', '', '', 'z', 4, 4, 4, 0, "
                     "0, 0);"
                     "INSERT INTO analysis VALUES (1, 1, '{}', '0.1.0');"
                     "INSERT INTO model VALUES (1, 1, 1, 'z', 'gm11', '{}', 0.1, 0.1, 0.1, 0.1, "
                     "0.2, 1, 'best', 'abc');"
                     "INSERT INTO model_point VALUES (1, 0, -10, 4.1, 4.2)")
            .has_value());
  }
  const auto migrated = migrate_database(path).value();
  CHECK(migrated.from == 1);
  CHECK(migrated.to == newest);
  CHECK(migrated.copy == path + ".schema-1");
  const auto store = Store::open_read_only(path).value();
  const auto models = store.models(CampaignId{1}, BoardId{1}, Axis::z).value();
  REQUIRE(models.size() == 1);
  CHECK(models[0].loocv_rmse_dps == 0.2);
  CHECK(std::isnan(models[0].block_rmse_dps));
  CHECK(models[0].warnings.empty());
  CHECK(std::isnan(models[0].points.at(0).band_dps));
  CHECK(dump(path + ".schema-1") != dump(path));
}
