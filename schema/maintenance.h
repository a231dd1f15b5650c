#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// Looks for damage and for rows that contradict each other: SQLite's own checks of pages, indexes,
/// and foreign keys, then the sample count of every dwell and the dwells of every model.
/// @return one sentence a problem; none for a sound database. Errors where it cannot be read.
[[nodiscard]] Result<std::vector<std::string>> problems_in_database(const std::string& path);

/// See schema/backup.h; works while a campaign writes.
[[nodiscard]] Result<void> backup_database(const std::string& path, const std::string& target);

struct Migrated {
  int from = 0;
  int to = 0;
  std::optional<std::string> copy;  ///< where the old database is kept; absent: nothing to do
};
/// Brings an existing database to the present schema, a copy kept beside it.
[[nodiscard]] Result<Migrated> migrate_database(const std::string& path);

/// Writes a copy of the present schema to `target` if the database is of an older one, which stays
/// as it is. @return whether it was; mismatch: a newer one, or another application's.
[[nodiscard]] Result<bool> copy_if_older(const std::string& path, const std::string& target);

}  // namespace gyrocal
