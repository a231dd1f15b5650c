#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gyrocal::cli {

/// A command's description in its parts: `Example:` lines first, then what it does.
struct Described {
  std::vector<std::string> examples;
  std::string text;
};
[[nodiscard]] Described described(const std::string& description);

/// The commands below one, in the order they were added.
[[nodiscard]] std::vector<const CLI::App*> subcommands(const CLI::App& command);
/// The one of that name below a command; nullptr: none.
[[nodiscard]] const CLI::App* subcommand_named(const CLI::App& command, const std::string& name);
[[nodiscard]] std::vector<const CLI::Option*> options(const CLI::App& command);

/// The words that call it: {"gyrocal", "rig", "serve"}.
[[nodiscard]] std::vector<std::string> path_of(const CLI::App& command);

/// "--db" and "-h", in that order.
[[nodiscard]] std::vector<std::string> flags_of(const CLI::Option& option);
[[nodiscard]] bool takes_value(const CLI::Option& option);
/// What an option with a closed set of values takes: {"x", "y", "z"}; empty: anything.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);

}  // namespace gyrocal::cli
