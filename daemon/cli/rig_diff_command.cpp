#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "config/rig_model.h"
#include "config/rig_model_diff.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/rig_command.h"

namespace gyrocal::cli {
namespace {

struct DiffOptions {
  std::string from;
  std::string to;
  bool as_json = false;
};

void print_json(const std::vector<RigModelChange>& changes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const RigModelChange& change : changes) {
    all.push_back({{"where", change.where}, {"before", change.before}, {"after", change.after}});
  }
  fmt::print("{}\n", all.dump());
}

void print_text(const std::vector<RigModelChange>& changes) {
  if (changes.empty()) fmt::print("the two simulate alike\n");
  for (const RigModelChange& change : changes) {
    if (change.before.empty()) {
      fmt::print("+ {}, {}\n", change.where, change.after);
    } else if (change.after.empty()) {
      fmt::print("- {}, {}\n", change.where, change.before);
    } else {
      fmt::print("  {}: {} -> {}\n", change.where, change.before, change.after);
    }
  }
}

int diff(const DiffOptions& options) {
  const auto from = read_rig_model(options.from);
  if (!from) return report(from.error());
  const auto to = read_rig_model(options.to);
  if (!to) return report(to.error());
  const auto changes = rig_model_changes(*from, *to);
  if (options.as_json) {
    print_json(changes);
  } else {
    print_text(changes);
  }
  return exit_done;
}

}  // namespace

void add_rig_diff(Command& rig, Chosen& chosen) {
  auto* command = rig.add_subcommand("diff",
                                     "Example: gyrocal rig diff default found.json\n"
                                     "What the second rig model has that the first has not.");
  const auto options = std::make_shared<DiffOptions>();
  command->add_option("from", options->from, "a model's name or file")->required();
  command->add_option("to", options->to, "a model's name or file")->required();
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return diff(*options); }; });
}

}  // namespace gyrocal::cli
