#pragma once

#include <string>

#include "compensation/values/error.h"

namespace gyrocal {

/// The whole of a text file, for configuration and small CSV and JSON.
/// @return with path and reason: bad_input (missing, a directory), storage (no permission, a read
///   error).
[[nodiscard]] Result<std::string> read_text_file(const std::string& path);

}  // namespace gyrocal
