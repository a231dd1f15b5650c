#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/empirical_term.h"
#include "compensation/values/nearest_name.h"
#include "config/rig_model.h"
#include "config/rig_model_diff.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/rig_command.h"

namespace gyrocal::cli {
namespace {

struct ShowOptions {
  std::string what = default_rig_model;
  bool catalogue = false;
  bool as_json = false;
};

nlohmann::ordered_json law_json(const rig::Law& law) {
  nlohmann::ordered_json made{{"law", law.info.name}, {"equation", law.info.equation}};
  for (const rig::Parameter& p : law.info.parameters) {
    made["parameters"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"low", p.low},
                                  {"high", p.high},
                                  {"usual", p.usual},
                                  {"meaning", p.meaning}});
  }
  return made;
}

nlohmann::ordered_json effect_json(const rig::Effect& effect) {
  nlohmann::ordered_json made{{"effect", effect.name}, {"physics", effect.physics}};
  for (const auto& law : effect.laws) made["laws"].push_back(law_json(*law));
  for (const rig::Confusion& confusion : effect.confused_with) {
    made["confused_with"].push_back(
        {{"effect", confusion.effect}, {"tell_apart", confusion.tell_apart}});
  }
  return made;
}

void print_effect(const rig::Effect& effect) {
  fmt::print("{}\n  {}\n", effect.name, effect.physics);
  for (const auto& law : effect.laws) {
    fmt::print("  law {}: {}\n", law->info.name, law->info.equation);
    for (const rig::Parameter& p : law->info.parameters) {
      fmt::print("    {:<12} {:g} ({:g}..{:g}) {}: {}\n", p.name, p.usual, p.low, p.high, p.unit,
                 p.meaning);
    }
  }
  for (const rig::Confusion& confusion : effect.confused_with) {
    fmt::print("  confused with {}; apart by: {}\n", confusion.effect, confusion.tell_apart);
  }
}

int show_catalogue(bool as_json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const rig::Effect& effect : rig::catalogue()) {
    if (as_json) {
      all.push_back(effect_json(effect));
    } else {
      print_effect(effect);
    }
  }
  if (as_json) fmt::print("{}\n", all.dump());
  return exit_done;
}

void print_model(const rig::RigModel& model) {
  fmt::print("rig model {}, hash {}", model.name, rig_model_hash(model));
  if (!model.parent.empty()) fmt::print(", made from {} ({})", model.parent, model.parent_hash);
  const rig::Baseline& base = model.baseline;
  fmt::print("\nlags: air -> board {} s -> die {} s\n", base.board_tau_s, base.die_tau_s);
  fmt::print("ramps: {} degC/min up, {} down; cycling +-{} degC every {} s; ambient {} degC\n",
             base.chamber.heating_c_per_min, base.chamber.cooling_c_per_min, base.chamber.cycling_c,
             base.chamber.cycling_period_s, base.chamber.ambient_c);
  fmt::print("bias [deg/s] over die temperature:\n  degC ");
  for (const int t : {-10, 0, 10, 20, 30, 40, 50}) fmt::print("{:>9}", t);
  for (const Axis axis : all_axes) {
    fmt::print("\n  {:<5}", letter(axis));
    for (const int t : {-10, 0, 10, 20, 30, 40, 50}) {
      fmt::print("{:>9.4f}", base.bias[static_cast<std::size_t>(axis)].at(t));
    }
  }
  fmt::print("\nnoise {} deg/s a sample, {} LSB/(deg/s), board sensor in steps of {} degC\n",
             base.noise_dps, base.lsb_per_dps, base.board_sensor_step_c);
  if (model.effects.empty()) fmt::print("no effects\n");
  for (const auto& use : model.effects) {
    fmt::print("effect {}, law {}: {}\n", use.effect, use.law, effect_values(use));
  }
  for (const auto& term : model.unexplained) {
    fmt::print("unexplained: a curve of {} knots over {}\n", term.at.size(),
               rig::name_of(term.driver));
  }
}

/// What is no file may be an effect's name with a letter wrong.
Error with_nearest_effect(Error error, const std::string& asked) {
  std::vector<std::string_view> names;
  for (const rig::Effect& effect : rig::catalogue()) names.emplace_back(effect.name);
  error.advice.insert(0, is_meant(asked, names));
  return error;
}

int show(const ShowOptions& options) {
  if (options.catalogue) return show_catalogue(options.as_json);
  if (const rig::Effect* effect = rig::find_effect(options.what)) {
    if (options.as_json) {
      fmt::print("{}\n", effect_json(*effect).dump());
    } else {
      print_effect(*effect);
    }
    return exit_done;
  }
  const auto model = read_rig_model(options.what);
  if (!model) return report(with_nearest_effect(model.error(), options.what));
  if (options.as_json) {
    fmt::print("{}\n", rig_model_to_json(*model));
  } else {
    print_model(*model);
  }
  return exit_done;
}

}  // namespace

void add_rig_show(Command& rig, Chosen& chosen) {
  auto* command = rig.add_subcommand("show",
                                     "Example: gyrocal rig show quiet_hysteresis\n"
                                     "         gyrocal rig show thermal_hysteresis\n"
                                     "         gyrocal rig show default --json > mine.json\n"
                                     "Shows a rig model, or an effect that one can contain.");
  const auto options = std::make_shared<ShowOptions>();
  command->add_option("what", options->what, "a model's name or file, or an effect's name");
  command->add_flag("--catalogue", options->catalogue, "all effects with their laws");
  command->add_flag("--json", options->as_json, "print JSON; of a model: its file");
  command->callback([options, &chosen] { chosen = [options] { return show(*options); }; });
}

}  // namespace gyrocal::cli
