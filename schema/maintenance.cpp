#include "schema/maintenance.h"

#include <fmt/core.h>

#include "schema/backup.h"
#include "schema/migrate.h"
#include "schema/open_database.h"
#include "schema/writer_lock.h"

namespace gyrocal {
namespace {

/// Each gives one text a problem.
constexpr const char* checks[] = {
    "SELECT integrity_check FROM pragma_integrity_check WHERE integrity_check <> 'ok'",
    "SELECT \"table\" || coalesce(' row ' || rowid, '') || ' refers to a row of ' || parent || ' "
    "that "
    "is not there' FROM pragma_foreign_key_check",
    "SELECT 'dwell ' || id || ' counts ' || samples || ' samples, ' || stored || ' are stored' "
    "FROM "
    "(SELECT id, samples, (SELECT count(*) FROM sample WHERE dwell_id = dwell.id) AS stored FROM "
    "dwell) WHERE samples <> stored",
    "SELECT 'model ' || model.id || ' was fitted to dwell ' || dwell.id || ', which ' || CASE WHEN "
    "dwell.board_id <> model.board_id THEN 'is another board''s' ELSE 'is rejected' END FROM model "
    "JOIN model_dwell ON model_id = model.id JOIN dwell ON dwell.id = dwell_id WHERE "
    "dwell.board_id "
    "<> model.board_id OR reject_reason IS NOT NULL"};

}  // namespace

Result<std::vector<std::string>> problems_in_database(const std::string& path) {
  const auto database = open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  std::vector<std::string> problems;
  for (const char* check : checks) {
    auto rows = database->prepare(check);
    if (!rows) return tl::unexpected(rows.error());
    for (;;) {
      const auto more = rows->next();
      if (!more) return tl::unexpected(more.error());
      if (!*more) break;
      problems.push_back(rows->text(0));
    }
  }
  return problems;
}

Result<void> backup_database(const std::string& path, const std::string& target) {
  const auto database = open_to_read(path);
  if (!database) return tl::unexpected(database.error());
  return backup(*database, target);
}

Result<Migrated> migrate_database(const std::string& path) {
  const auto migrations = embedded_migrations();
  const int newest = newest_version(migrations);
  int from = 0;
  {
    const auto before = Database::open(path, OpenMode::read_only);  // a missing file stays missing
    if (!before) return tl::unexpected(before.error());
    const auto state = schema_state(*before, newest);
    if (!state) return tl::unexpected(state.error());
    from = state->version;
  }
  if (from == newest) return Migrated{from, newest, std::nullopt};
  const auto lock = WriterLock::take(path);
  if (!lock) return tl::unexpected(lock.error());
  const auto database = Database::open(path, OpenMode::read_write_create);
  if (!database) return tl::unexpected(database.error());
  const auto done = migrate(*database, migrations, embedded_views());
  if (!done) return tl::unexpected(done.error());
  return Migrated{from, newest, fmt::format("{}.schema-{}", path, from)};
}

Result<bool> copy_if_older(const std::string& path, const std::string& target) {
  if (open_to_read(path)) return false;  // also where nobody can write
  {
    const auto database = Database::open(path, OpenMode::read_only);
    if (!database) return tl::unexpected(database.error());
    const int newest = newest_version(embedded_migrations());
    const auto state = schema_state(*database, newest);
    if (!state) return tl::unexpected(state.error());
    if (state->empty) return fail(Errc::mismatch, path + ": holds nothing");
    if (auto copied = backup(*database, target); !copied) return tl::unexpected(copied.error());
  }
  const auto migrated = migrate_database(target);
  if (!migrated) return tl::unexpected(migrated.error());
  return true;
}

}  // namespace gyrocal
