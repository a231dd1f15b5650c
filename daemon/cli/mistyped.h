#pragma once

#include <string>
#include <vector>

#include "daemon/cli/command_line.h"

namespace gyrocal::cli {

/// Looks for the first command or option among the words that is none, or a value outside the
/// closed set that an option takes.
/// @param words  what follows the program's name.
/// @return a sentence with the nearest name where one is near; empty: none is mistyped.
[[nodiscard]] std::string mistyped(const Command& root, const std::vector<std::string>& words);

}  // namespace gyrocal::cli
