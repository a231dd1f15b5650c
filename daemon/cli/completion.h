#pragma once

#include <string>

#include "daemon/cli/command_line.h"

namespace gyrocal::cli {

/// Completion scripts for commands, options and closed sets of values; files elsewhere.
[[nodiscard]] std::string bash_completion(const Command& root);
[[nodiscard]] std::string zsh_completion(const Command& root);
[[nodiscard]] std::string fish_completion(const Command& root);

}  // namespace gyrocal::cli
