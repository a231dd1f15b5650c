#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/rig_model.h"
#include "daemon/cli/axis_name.h"
#include "daemon/cli/command.h"
#include "daemon/cli/outcome.h"
#include "daemon/cli/plan_file.h"
#include "daemon/cli/text_output.h"

namespace gyrocal::cli {
namespace {

using Json = nlohmann::ordered_json;

struct PlanOptions {
  std::string campaign;
  std::string rig_model = default_rig_model;
  std::string axis = "z";
  std::string write;
  bool as_json = false;
};

struct PlanAnswer {
  PlanPower power;
  std::vector<PlanAddition> additions;
};

Json pair_json(const PlanPair& pair) {
  return {
      {"effect", pair.effect},         {"rival", pair.rival}, {"share_left", pair.share_left},
      {"apart_from", pair.apart_from}, {"unit", pair.unit},   {"told_apart", is_told_apart(pair)},
      {"tell_apart", pair.tell_apart}};
}

Json answer_json(const PlanAnswer& answer) {
  Json limits = Json::object();
  for (const PlanLimit& limit : answer.power.limits) {
    limits[limit.effect] = {{"amplitude", limit.limit}, {"unit", limit.unit}};
  }
  Json pairs = Json::array();
  for (const PlanPair& pair : answer.power.pairs) pairs.push_back(pair_json(pair));
  Json additions = Json::array();
  for (const PlanAddition& addition : answer.additions) {
    Json separated = Json::array();
    for (const PlanPair& pair : addition.separated) separated.push_back(pair_json(pair));
    additions.push_back({{"what", addition.what},
                         {"extra_h", addition.extra_h},
                         {"separates", std::move(separated)}});
  }
  return {{"format", "gyrocal-plan/1"},
          {"dwells", answer.power.dwells},
          {"duration_h", answer.power.duration_h},
          {"detection_limits", std::move(limits)},
          {"not_observable", answer.power.not_observable},
          {"pairs", std::move(pairs)},
          {"additions", std::move(additions)}};
}

void print_pairs(const PlanPower& power) {
  const auto open = std::count_if(power.pairs.begin(), power.pairs.end(),
                                  [](const PlanPair& pair) { return !is_told_apart(pair); });
  if (open == 0) {
    fmt::print("\nEvery pair of drifts is told apart.\n");
    return;
  }
  fmt::print("\nPairs this plan hardly tells apart\n{:<21}{:<21}{:>12}  {:<18}{}\n", "effect",
             "taken for", "below", "", "what would tell");
  for (const PlanPair& pair : power.pairs) {
    if (is_told_apart(pair)) continue;
    fmt::print("{:<21}{:<21}{:>12.4g}  {:<18}{}\n", pair.effect, pair.rival, pair.apart_from,
               pair.unit, pair.tell_apart);
  }
}

void print_additions(const std::vector<PlanAddition>& additions) {
  fmt::print("\nWhat would change that\n");
  for (const PlanAddition& addition : additions) {
    fmt::print("{} ({:+.1f} h): {}\n", addition.what, addition.extra_h,
               addition.separated.empty() ? "separates no pair" : "separates");
    for (const PlanPair& pair : addition.separated) {
      fmt::print("  {} and {}, from {:.4g} {} on\n", pair.effect, pair.rival, pair.apart_from,
                 pair.unit);
    }
  }
}

void print_text(const PlanAnswer& answer) {
  fmt::print("{} dwells, {:.1f} h on the simulated rig\n\nSmallest amplitudes it would show\n",
             answer.power.dwells, answer.power.duration_h);
  for (const PlanLimit& limit : answer.power.limits) {
    fmt::print("{:<32}{:>12.4g}  {}\n", limit.effect, limit.limit, limit.unit);
  }
  for (const std::string& effect : answer.power.not_observable) {
    fmt::print("{:<32}{:>12}\n", effect, "not at all");
  }
  print_pairs(answer.power);
  print_additions(answer.additions);
}

int plan(const PlanOptions& options) {
  const auto config = read_campaign(options.campaign);
  if (!config) return report(config.error());
  const auto model = read_rig_model(options.rig_model);
  if (!model) return report(model.error());
  const rig::SessionPlan session = session_plan(*config);
  const Axis axis = axis_named(options.axis);
  auto power = plan_power(session, *model, axis);
  if (!power) return report(power.error());
  auto additions = plan_additions(session, *model, axis, *power);
  if (!additions) return report(additions.error());
  const PlanAnswer answer{std::move(*power), std::move(*additions)};
  if (options.as_json) {
    fmt::print("{}\n", answer_json(answer).dump());
  } else {
    print_text(answer);
  }
  if (options.write.empty()) return exit_done;
  const auto text = campaign_with_best(*config, answer.additions, {});
  if (!text) return report(text.error());
  const auto written = write_text_file(options.write, *text);
  return written ? exit_done : report(written.error());
}

}  // namespace

void add_plan(Command& root, Chosen& chosen) {
  auto* command = root.add_subcommand(
      "plan",
      "Example: gyrocal plan config/campaigns/weekend.toml\n"
      "Example: gyrocal plan weekend.toml --write weekend_apart.toml\n"
      "Says before a campaign which effects it would show, from which amplitude on, which pairs of "
      "drifts its plan could not tell apart, and what the cheapest additions would change.");
  const auto options = std::make_shared<PlanOptions>();
  command->add_option("campaign", options->campaign, "campaign file (TOML)")->required();
  command->add_option("--rig-model", options->rig_model, "file, or the name of a shipped model")
      ->capture_default_str();
  command->add_option("--axis", options->axis, "x, y or z")
      ->capture_default_str()
      ->one_of({"x", "y", "z"});
  command->add_option("--write", options->write,
                      "a campaign file with the addition that separates most for its hours");
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &chosen] { chosen = [options] { return plan(*options); }; });
}

}  // namespace gyrocal::cli
