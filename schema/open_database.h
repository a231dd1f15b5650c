#pragma once

#include <string>

#include "compensation/values/error.h"
#include "schema/sqlite.h"

namespace gyrocal {

/// A database of ours, of the present schema, for reading only: also while a campaign writes, and
/// where nobody can write, the folder neither.
/// @return storage, or mismatch: no database, of another application, empty, older or newer.
[[nodiscard]] Result<Database> open_to_read(const std::string& path);

}  // namespace gyrocal
