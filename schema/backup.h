#pragma once

#include <string>

#include "compensation/values/error.h"
#include "schema/sqlite.h"

namespace gyrocal {

/// Writes a consistent copy of a database, also while a campaign writes to it: one file, compacted,
/// complete on disk before it appears under `target`. An existing target is refused (busy).
[[nodiscard]] Result<void> backup(const Database& database, const std::string& target);

}  // namespace gyrocal
