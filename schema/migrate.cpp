#include "schema/migrate.h"

#include <fmt/core.h>

#include <cstdlib>

#include "schema/backup.h"

namespace gyrocal {
namespace {

int version_of(const SqlFile& migration) {
  return std::atoi(std::string(migration.name.substr(0, 3)).c_str());
}

Result<void> renew_views(const Database& database, std::span<const SqlFile> views) {
  auto old = database.prepare("SELECT name FROM sqlite_schema WHERE type = 'view'");
  if (!old) return tl::unexpected(old.error());
  std::string script;
  for (;;) {
    const auto row = old->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    script += fmt::format("DROP VIEW \"{}\";\n", old->text(0));
  }
  for (const SqlFile& view : views) script += std::string(view.text) + "\n";
  return database.execute(script);
}

Result<void> apply(const Database& database, int from, std::span<const SqlFile> migrations,
                   std::span<const SqlFile> views) {
  for (const SqlFile& migration : migrations) {
    if (version_of(migration) <= from) continue;
    if (auto done = database.execute(std::string(migration.text)); !done) return done;
  }
  if (auto done = renew_views(database, views); !done) return done;
  return database.execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}",
                                      application_id, newest_version(migrations)));
}

}  // namespace

int newest_version(std::span<const SqlFile> migrations) { return version_of(migrations.back()); }

Result<SchemaState> schema_state(const Database& database, int known) {
  const auto application = database.integer("PRAGMA application_id");
  if (!application) return tl::unexpected(application.error());
  const auto version = database.integer("PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  const auto things = database.integer("SELECT count(*) FROM sqlite_schema");
  if (!things) return tl::unexpected(things.error());
  if (*application == 0 && *version == 0 && *things == 0) return SchemaState{0, true};
  if (*application != application_id) {
    return fail(Errc::mismatch,
                fmt::format("{}: a database of another application (application_id {:#x}, expected "
                            "{:#x})",
                            database.path(), *application, application_id),
                "give the name of a gyrocal database, or of a new file");
  }
  if (*version > known) {
    return fail(Errc::mismatch,
                fmt::format("{}: schema {}, written by a newer gyrocal; this one knows up to {}",
                            database.path(), *version, known),
                "install the newer gyrocal");
  }
  return SchemaState{static_cast<int>(*version), false};
}

Result<bool> migrate(const Database& database, std::span<const SqlFile> migrations,
                     std::span<const SqlFile> views) {
  const auto state = schema_state(database, newest_version(migrations));
  if (!state) return tl::unexpected(state.error());
  if (state->version == newest_version(migrations)) return false;
  if (!state->empty) {
    const auto kept = fmt::format("{}.schema-{}", database.path(), state->version);
    if (auto copied = backup(database, kept); !copied) return tl::unexpected(copied.error());
  }
  const auto done =
      database.transaction([&] { return apply(database, state->version, migrations, views); });
  if (!done) return tl::unexpected(done.error());
  return true;
}

}  // namespace gyrocal
