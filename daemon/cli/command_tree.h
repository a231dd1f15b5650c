#pragma once

#include <string>
#include <vector>

#include "daemon/cli/command_line.h"

namespace gyrocal::cli {

/// A command's description in its parts: `Example:` lines first, then what it does.
struct Described {
  std::vector<std::string> examples;
  std::string text;
};
[[nodiscard]] Described described(const std::string& description);

/// The one of that name below a command; nullptr: none.
[[nodiscard]] const Command* subcommand_named(const Command& command, const std::string& name);

/// The names of the commands below one, in the order they were added.
[[nodiscard]] std::vector<std::string> subcommand_names(const Command& command);

/// The words that call it: {"gyrocal", "rig", "serve"}.
[[nodiscard]] std::vector<std::string> path_of(const Command& command);

/// "--db" and "-h", in that order.
[[nodiscard]] std::vector<std::string> flags_of(const Option& option);
/// What an option with a closed set of values takes: {"x", "y", "z"}; empty: anything.
[[nodiscard]] std::vector<std::string> choices_of(const Option& option);

}  // namespace gyrocal::cli
