#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "compensation/rig/effects/effect.h"
#include "compensation/rig/empirical_term.h"
#include "config/rig_model.h"
#include "config/rig_model_fields.h"

namespace gyrocal {
namespace {

using nlohmann::ordered_json;

template <class Owner, std::size_t n>
void write_fields(const Owner& owner, const std::array<NumberField<Owner>, n>& fields,
                  ordered_json& into) {
  for (const auto& field : fields) into[std::string(field.name)] = owner.*(field.member);
}

std::string letters(const std::array<bool, 3>& axes) {
  std::string chosen;
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes[i]) chosen += "xyz"[i];
  }
  return chosen;
}

ordered_json baseline_json(const rig::Baseline& baseline) {
  ordered_json made;
  write_fields(baseline.chamber, chamber_fields, made["chamber"]);
  for (const Axis axis : all_axes) {
    made["bias_dps"][std::string(1, letter(axis))] =
        baseline.bias[static_cast<std::size_t>(axis)].dps;
  }
  write_fields(baseline, baseline_fields, made);
  made["code_limit"] = baseline.code_limit;
  return made;
}

ordered_json effect_json(const rig::EffectUse& given) {
  const rig::EffectUse use = rig::completed(given);
  ordered_json made{{"effect", use.effect}, {"law", use.law}};
  made["parameters"] = ordered_json::object();
  for (const auto& [name, value] : use.parameters) made["parameters"][name] = value;
  made["axes"] = letters(use.axes);
  if (!use.boards.empty()) made["boards"] = use.boards;
  return made;
}

ordered_json unexplained_json(const rig::EmpiricalTerm& term) {
  ordered_json made{{"driver", rig::name_of(term.driver)}};
  if (term.driver == rig::EmpiricalDriver::phase) made["period_s"] = term.period_s;
  made["at"] = term.at;
  if (term.noise_factor.empty()) {
    made["dps"] = term.dps;
  } else {
    made["noise_factor"] = term.noise_factor;
  }
  made["axes"] = letters(term.axes);
  return made;
}

/// What decides how the model simulates: everything but the names.
void write_contents(const rig::RigModel& model, ordered_json& into) {
  into["baseline"] = baseline_json(model.baseline);
  into["effects"] = ordered_json::array();
  for (const auto& use : model.effects) into["effects"].push_back(effect_json(use));
  into["unexplained"] = ordered_json::array();
  for (const auto& term : model.unexplained) into["unexplained"].push_back(unexplained_json(term));
}

}  // namespace

std::string rig_model_to_json(const rig::RigModel& model) {
  ordered_json made{{"format", "gyrocal-rig-model/1"},
                    {"name", model.name},
                    {"parent", model.parent},
                    {"parent_hash", model.parent_hash}};
  write_contents(model, made);
  return made.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

std::string rig_model_hash(const rig::RigModel& model) {
  ordered_json contents;
  write_contents(model, contents);
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : contents.dump()) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace gyrocal
