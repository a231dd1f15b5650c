#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "gyrocal_version.h"

namespace gyrocal::cli {

void add_version(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand("version", "Example: gyrocal version --json");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "print JSON");
  command->callback([as_json, &chosen] {
    chosen = [as_json] {
      if (*as_json) {
        fmt::print("{}\n", nlohmann::json{{"version", GYROCAL_VERSION}}.dump());
      } else {
        fmt::print("gyrocal {}\n", GYROCAL_VERSION);
      }
      return exit_done;
    };
  });
}

}  // namespace gyrocal::cli
