#pragma once

#include <string>

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// The whole of a file, anew. @return storage with path and reason.
[[nodiscard]] Result<void> write_text_file(const std::string& path, const std::string& text);

}  // namespace gyrocal::cli
