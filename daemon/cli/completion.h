#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gyrocal::cli {

/// Completion scripts for commands, options and closed sets of values; files elsewhere.
[[nodiscard]] std::string bash_completion(const CLI::App& root);
[[nodiscard]] std::string zsh_completion(const CLI::App& root);
[[nodiscard]] std::string fish_completion(const CLI::App& root);

}  // namespace gyrocal::cli
