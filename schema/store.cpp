#include "schema/store.h"

#include <fmt/core.h>

#include <filesystem>

#include "schema/migrate.h"
#include "schema/store_impl.h"

namespace gyrocal {
namespace {

/// Every commit is on disk when it returns, whatever happens to the power.
constexpr char writer_settings[] =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;";

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

Result<Database> open_to_read(const std::string& path) {
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

Store::Store(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Result<Store> Store::open(const std::string& path) {
  auto lock = WriterLock::take(path);
  if (!lock) return tl::unexpected(lock.error());
  auto database = Database::open(path, OpenMode::read_write_create);
  if (!database) return tl::unexpected(database.error());
  // SQLite opens what it may not write for reading; better found out now than after an hour.
  if (database->read_only()) {
    return fail(Errc::storage, fmt::format("open {} to write: Permission denied", path),
                "check the permissions of the file and its folder");
  }
  const auto migrated = migrate(*database, embedded_migrations(), embedded_views());
  if (!migrated) return tl::unexpected(migrated.error());
  if (auto set = database->execute(writer_settings); !set) return tl::unexpected(set.error());
  return Store(std::make_unique<Impl>(Impl{std::move(*lock), std::move(*database), std::nullopt}));
}

Result<Store> Store::open_read_only(const std::string& path) {
  auto database = open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  if (auto sound = expect_present_schema(*database); !sound) return tl::unexpected(sound.error());
  return Store(std::make_unique<Impl>(Impl{std::nullopt, std::move(*database), std::nullopt}));
}

Result<void> Store::Impl::write(const std::string& what,
                                const std::function<Result<void>()>& body) {
  return with_context(database.transaction(body), "store " + what);
}

}  // namespace gyrocal
