#include "config/rig_model_diff.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "compensation/rig/effects/effect.h"
#include "compensation/rig/empirical_term.h"
#include "config/rig_model_fields.h"

namespace gyrocal {
namespace {

using Changes = std::vector<RigModelChange>;

void compare(const std::string& where, double from, double to, Changes& into) {
  if (from != to) into.push_back({where, fmt::format("{}", from), fmt::format("{}", to)});
}

template <class Owner, std::size_t n>
void compare_fields(const std::string& where, const Owner& from, const Owner& to,
                    const std::array<NumberField<Owner>, n>& fields, Changes& into) {
  for (const auto& field : fields) {
    compare(where + std::string(field.name), from.*(field.member), to.*(field.member), into);
  }
}

void compare_baseline(const rig::Baseline& from, const rig::Baseline& to, Changes& into) {
  compare_fields("baseline.chamber.", from.chamber, to.chamber, chamber_fields, into);
  for (const Axis axis : all_axes) {
    const auto i = static_cast<std::size_t>(axis);
    if (from.bias[i] == to.bias[i]) continue;
    into.push_back({fmt::format("baseline.bias_dps.{}", letter(axis)),
                    fmt::format("{}", fmt::join(from.bias[i].dps, " ")),
                    fmt::format("{}", fmt::join(to.bias[i].dps, " "))});
  }
  compare_fields("baseline.", from, to, baseline_fields, into);
  compare("baseline.code_limit", from.code_limit, to.code_limit, into);
}

std::string whose(const rig::EffectUse& use) {
  std::vector<std::string> axes;
  for (const Axis axis : all_axes) {
    if (use.axes[static_cast<std::size_t>(axis)]) axes.emplace_back(1, letter(axis));
  }
  std::string text = axes.size() == 3 ? "" : fmt::format(" on {}", fmt::join(axes, ", "));
  if (!use.boards.empty()) text += fmt::format(" of board {}", fmt::join(use.boards, ", "));
  return text;
}

std::string felt_by(const rig::EffectUse& use) {
  const std::string text = whose(use);
  return text.empty() ? "all axes" : text.substr(1);
}

void compare_effect(const rig::EffectUse& from, const rig::EffectUse& to, Changes& into) {
  const std::string name = "effect " + from.effect;
  if (from.law != to.law) {
    into.push_back(
        {name + ": law", from.law + ": " + effect_values(from), to.law + ": " + effect_values(to)});
    return;
  }
  for (std::size_t i = 0; i < from.parameters.size(); ++i) {
    const auto& [parameter, value] = from.parameters[i];
    compare(name + ": " + parameter, value, to.parameters[i].second, into);
  }
  if (from.axes != to.axes || from.boards != to.boards) {
    into.push_back({name + ": felt", felt_by(from), felt_by(to)});
  }
}

void compare_effects(const std::vector<rig::EffectUse>& from, const std::vector<rig::EffectUse>& to,
                     Changes& into) {
  std::vector<bool> paired(to.size(), false);
  for (const auto& given : from) {
    const rig::EffectUse old = rig::completed(given);
    std::size_t match = 0;
    while (match < to.size() && (paired[match] || to[match].effect != old.effect)) ++match;
    if (match < to.size()) {
      paired[match] = true;
      compare_effect(old, rig::completed(to[match]), into);
    } else {
      into.push_back({"effect " + old.effect, old.law + ": " + effect_values(old), ""});
    }
  }
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (paired[i]) continue;
    const rig::EffectUse added = rig::completed(to[i]);
    into.push_back({"effect " + added.effect, "", added.law + ": " + effect_values(added)});
  }
}

std::string term_text(const rig::EmpiricalTerm& term) {
  const bool drifts = term.noise_factor.empty();
  const std::vector<double>& values = drifts ? term.dps : term.noise_factor;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{} knots over {}, {}..{} {}", term.at.size(), rig::name_of(term.driver), *low,
                     *high, drifts ? "dps" : "times the noise");
}

void compare_unexplained(const std::vector<rig::EmpiricalTerm>& from,
                         const std::vector<rig::EmpiricalTerm>& to, Changes& into) {
  for (const auto& term : from) {
    if (std::find(to.begin(), to.end(), term) == to.end()) {
      into.push_back({"unexplained", term_text(term), ""});
    }
  }
  for (const auto& term : to) {
    if (std::find(from.begin(), from.end(), term) == from.end()) {
      into.push_back({"unexplained", "", term_text(term)});
    }
  }
}

}  // namespace

std::string effect_values(const rig::EffectUse& use) {
  const auto instance = rig::instantiate(use);
  if (!instance) return to_text(instance.error());
  std::string text;
  for (std::size_t i = 0; i < instance->values.size(); ++i) {
    const rig::Parameter& parameter = instance->law->info.parameters[i];
    text +=
        fmt::format("{}{} = {}{}{}", text.empty() ? "" : ", ", parameter.name, instance->values[i],
                    parameter.unit == "1" ? "" : " ", parameter.unit == "1" ? "" : parameter.unit);
  }
  return text + whose(use);
}

std::vector<RigModelChange> rig_model_changes(const rig::RigModel& from, const rig::RigModel& to) {
  Changes changes;
  compare_baseline(from.baseline, to.baseline, changes);
  compare_effects(from.effects, to.effects, changes);
  compare_unexplained(from.unexplained, to.unexplained, changes);
  return changes;
}

}  // namespace gyrocal
