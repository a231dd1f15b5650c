#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "compensation/values/error.h"
#include "schema/embedded_sql.h"
#include "schema/sqlite.h"

namespace gyrocal {

inline constexpr std::int64_t application_id = 0x47595243;  ///< "GYRC", in the file's header

/// The schema version a set of migrations leads to: the leading number of the last file.
[[nodiscard]] int newest_version(std::span<const SqlFile> migrations);

/// What a file is, before anything is written to it.
struct SchemaState {
  int version = 0;     ///< 0: empty
  bool empty = false;  ///< no table of anybody
};
/// @return mismatch for a database of another application or of a newer schema than `known`.
[[nodiscard]] Result<SchemaState> schema_state(const Database& database, int known);

/// Brings a database to the newest version in one transaction: the tables by the migrations it
/// lacks, the views anew. A database that holds something is copied first, to PATH.schema-N.
/// @return whether anything was done; on error the database is as it was.
[[nodiscard]] Result<bool> migrate(const Database& database, std::span<const SqlFile> migrations,
                                   std::span<const SqlFile> views);

}  // namespace gyrocal
