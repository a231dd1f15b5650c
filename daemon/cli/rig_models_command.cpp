#include <fmt/core.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "config/rig_model.h"
#include "config/shipped_names.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/rig_command.h"

namespace gyrocal::cli {
namespace {

nlohmann::json summary(const rig::RigModel& model) {
  std::vector<std::string> effects;
  for (const auto& use : model.effects) effects.push_back(use.effect);
  return {{"name", model.name},
          {"parent", model.parent},
          {"hash", rig_model_hash(model)},
          {"noise_dps", model.baseline.noise_dps},
          {"effects", effects}};
}

int list_models(bool as_json) {
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& name : shipped_names(rig_model_folders(), ".json")) {
    const auto model = read_rig_model(name);
    if (!model) return report(model.error());
    all.push_back(summary(*model));
  }
  if (as_json) {
    fmt::print("{}\n", all.dump());
    return exit_done;
  }
  fmt::print("{:<20} {:<16} {:<12} {:>11}  {}\n", "name", "hash", "parent", "noise deg/s",
             "effects");
  for (const auto& one : all) {
    const auto effects = one["effects"].get<std::vector<std::string>>();
    fmt::print("{:<20} {:<16} {:<12} {:>11}  {}\n", one["name"].get<std::string>(),
               one["hash"].get<std::string>(), one["parent"].get<std::string>(),
               one["noise_dps"].get<double>(), fmt::join(effects, ", "));
  }
  return exit_done;
}

}  // namespace

void add_rig_models(Command& rig, Chosen& chosen) {
  auto* command = rig.add_subcommand("models",
                                     "Example: gyrocal rig models\n"
                                     "Lists the rig models that can be given by name.");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "print JSON");
  command->callback([as_json, &chosen] { chosen = [as_json] { return list_models(*as_json); }; });
}

}  // namespace gyrocal::cli
