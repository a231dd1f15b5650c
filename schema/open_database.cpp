#include "schema/open_database.h"

#include <fmt/core.h>

#include <filesystem>

#include "schema/migrate.h"

namespace gyrocal {
namespace {

Result<void> expect_present_schema(const Database& database) {
  const int newest = newest_version(embedded_migrations());
  const auto state = schema_state(database, newest);
  if (!state) return tl::unexpected(state.error());
  if (state->empty) {
    return fail(Errc::mismatch, fmt::format("{}: holds nothing", database.path()),
                "is this the database a campaign wrote?");
  }
  if (state->version < newest) {
    return fail(Errc::mismatch,
                fmt::format("{}: schema {}, expected {}", database.path(), state->version, newest),
                fmt::format("`gyrocal db migrate {}` brings it up to date and keeps a copy",
                            database.path()));
  }
  return {};
}

Result<Database> open_any(const std::string& path) {
  auto database = Database::open(path, OpenMode::read_only);
  if (!database) return database;
  // WAL wants to make files beside the database. Where the folder forbids it nobody can be writing,
  // so the file can be read as it stands.
  if (database->integer("PRAGMA schema_version") || std::filesystem::exists(path + "-wal")) {
    return database;
  }
  auto immutable = Database::open(path, OpenMode::immutable);
  return immutable && immutable->integer("PRAGMA schema_version") ? std::move(immutable)
                                                                  : std::move(database);
}

}  // namespace

Result<Database> open_to_read(const std::string& path) {
  auto database = open_any(path);
  if (!database) return database;
  if (auto sound = expect_present_schema(*database); !sound) return tl::unexpected(sound.error());
  return database;
}

}  // namespace gyrocal
