#pragma once

#include <string>
#include <vector>

namespace gyrocal {

/// What can be named without a path: NAME for each NAME`extension` in `folders`, sorted, each once.
/// A folder that is missing or cannot be read holds none.
[[nodiscard]] std::vector<std::string> shipped_names(const std::vector<std::string>& folders,
                                                     const std::string& extension);

}  // namespace gyrocal
