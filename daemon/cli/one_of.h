#pragma once

#include <string>
#include <vector>

namespace gyrocal::cli {

/// The advice for a name that is none of `names`: `is "board0" meant? boards: board0, board1`.
/// @param what  what the names are of, in the plural.
[[nodiscard]] std::string one_of(const std::string& asked, const char* what,
                                 const std::vector<std::string>& names);

}  // namespace gyrocal::cli
