#pragma once

#include <string>

#include "compensation/values/error.h"

namespace gyrocal {

/// The whole of a text file, for configuration and small CSV and JSON.
/// @return storage, with path and reason (missing, a directory, no permission, read error).
[[nodiscard]] Result<std::string> read_text_file(const std::string& path);

}  // namespace gyrocal
