#pragma once

#include <string>
#include <utility>
#include <vector>

#include "daemon/cli/command_line.h"

namespace gyrocal::cli {

/// The man page of a command in man(7): name, synopsis, examples, description, options, commands,
/// exit status.
[[nodiscard]] std::string manual_page(const Command& command, const std::string& version);

/// The pages of a command and of all below it: {"gyrocal-rig-serve.1", text}.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> manual_pages(
    const Command& command, const std::string& version);

}  // namespace gyrocal::cli
