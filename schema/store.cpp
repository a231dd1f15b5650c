#include "schema/store.h"

#include <fmt/core.h>

#include "schema/migrate.h"
#include "schema/open_database.h"
#include "schema/store_impl.h"

namespace gyrocal {
namespace {

/// Of a new file; one that holds something keeps its own. A quarter of the system calls of the
/// usual 4 KiB: samples are written and read by the thousand.
constexpr char layout[] = "PRAGMA page_size = 16384";

/// Every commit is on disk when it returns, whatever happens to the power. Half a megabyte of cache
/// holds a group; what is read once is better not kept. The -wal file stays near 4 MB.
constexpr char writer_settings[] =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;"
    "PRAGMA cache_size = -500; PRAGMA wal_autocheckpoint = 250;";

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
  if (auto set = database->execute(layout); !set) return tl::unexpected(set.error());
  const auto migrated = migrate(*database, embedded_migrations(), embedded_views());
  if (!migrated) return tl::unexpected(migrated.error());
  if (auto set = database->execute(writer_settings); !set) return tl::unexpected(set.error());
  return Store(std::make_unique<Impl>(Impl{std::move(*lock), std::move(*database), std::nullopt}));
}

Result<Store> Store::open_read_only(const std::string& path) {
  auto database = open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  return Store(std::make_unique<Impl>(Impl{std::nullopt, std::move(*database), std::nullopt}));
}

Result<void> Store::Impl::write(const std::string& what,
                                const std::function<Result<void>()>& body) {
  return with_context(database.transaction(body), "store " + what);
}

}  // namespace gyrocal
