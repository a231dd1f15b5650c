#include "config/rig_model.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <cmath>
#include <iterator>
#include <set>

#include "compensation/rig/effects/effect.h"
#include "compensation/rig/empirical_term.h"
#include "compensation/values/nearest_name.h"
#include "config/json_node.h"
#include "config/places.h"
#include "config/rig_model_fields.h"
#include "config/shipped_names.h"
#include "config/text_file.h"

namespace gyrocal {
namespace {

constexpr std::string_view format_name = "gyrocal-rig-model/1";

template <class Owner, std::size_t n>
Result<void> read_fields(const JsonNode& object, const std::array<NumberField<Owner>, n>& fields,
                         Owner& into) {
  for (const auto& field : fields) {
    const std::string key(field.name);
    if (!object.has(key)) continue;
    const auto value = number(object.at(key), field.low, field.high);
    if (!value) return tl::unexpected(value.error());
    into.*(field.member) = *value;
  }
  return {};
}

template <class Owner, std::size_t n>
std::set<std::string> names_of(const std::array<NumberField<Owner>, n>& fields) {
  std::set<std::string> names;
  for (const auto& field : fields) names.emplace(field.name);
  return names;
}

Result<void> read_bias(const JsonNode& node, std::array<rig::CubicBias, 3>& into) {
  if (auto ok = only_keys(node, {"x", "y", "z"}); !ok) return ok;
  for (const Axis axis : all_axes) {
    const std::string key(1, letter(axis));
    if (!node.has(key)) continue;
    const auto values = numbers(node.at(key), -bias_dps_max, bias_dps_max);
    if (!values) return tl::unexpected(values.error());
    if (values->size() != 4) {
      return node.at(key).wrong(Errc::bad_input, fmt::format("{} numbers", values->size()),
                                "four: c0 + c1 u + c2 u^2 + c3 u^3, u = (T - 20)/30");
    }
    std::copy(values->begin(), values->end(), into[static_cast<std::size_t>(axis)].dps.begin());
  }
  return {};
}

Result<void> read_baseline(const JsonNode& node, rig::Baseline& into) {
  auto known = names_of(baseline_fields);
  known.insert({"chamber", "bias_dps", "code_limit"});
  if (auto ok = only_keys(node, known); !ok) return ok;
  if (auto ok = read_fields(node, baseline_fields, into); !ok) return ok;
  if (node.has("code_limit")) {
    const auto limit = number(node.at("code_limit"), 1, code_limit_max);
    if (!limit) return tl::unexpected(limit.error());
    into.code_limit = static_cast<int>(*limit);
  }
  if (node.has("bias_dps")) {
    if (auto ok = read_bias(node.at("bias_dps"), into.bias); !ok) return ok;
  }
  if (!node.has("chamber")) return {};
  const JsonNode chamber = node.at("chamber");
  if (auto ok = only_keys(chamber, names_of(chamber_fields)); !ok) return ok;
  return read_fields(chamber, chamber_fields, into.chamber);
}

Result<std::array<bool, 3>> read_axes(const JsonNode& object) {
  if (!object.has("axes")) return std::array<bool, 3>{true, true, true};
  std::string letters;
  if (auto ok = read_text(object, "axes", letters); !ok) return tl::unexpected(ok.error());
  std::array<bool, 3> axes{};
  for (const char one : letters) {
    if (one < 'x' || one > 'z')
      letters.clear();
    else
      axes[static_cast<std::size_t>(one - 'x')] = true;
  }
  if (letters.empty()) {
    return object.at("axes").wrong(Errc::bad_input, "not a choice of axes",
                                   "one to three of the letters x, y, z, as \"xz\"");
  }
  return axes;
}

Result<void> read_boards(const JsonNode& object, std::vector<std::uint32_t>& into) {
  if (!object.has("boards")) return {};
  const auto boards = numbers(object.at("boards"), 0, 1000);
  if (!boards) return tl::unexpected(boards.error());
  for (const double board : *boards) {
    if (board != std::floor(board)) {
      return object.at("boards").wrong(Errc::bad_input, "a board's index is a whole number");
    }
    into.push_back(static_cast<std::uint32_t>(board));
  }
  return {};
}

/// An error of instantiate() with its place: at the parameter, the law or the name it is about.
tl::unexpected<Error> placed(const JsonNode& node, const rig::EffectUse& use, const Error& error) {
  for (const auto& [name, value] : use.parameters) {
    if (error.what.find("parameter " + name + ":") != std::string::npos ||
        error.what.find("unknown parameter \"" + name + "\"") != std::string::npos) {
      return node.at("parameters").at(name).wrong(error.code, error.what, error.advice);
    }
  }
  const bool about_law = error.what.find("unknown law") != std::string::npos;
  return node.at(about_law ? "law" : "effect").wrong(error.code, error.what, error.advice);
}

Result<rig::EffectUse> read_effect(const JsonNode& node) {
  if (auto ok = only_keys(node, {"effect", "law", "parameters", "axes", "boards"}); !ok) {
    return tl::unexpected(ok.error());
  }
  rig::EffectUse use;
  if (!node.has("effect")) return node.wrong(Errc::bad_input, "no \"effect\": which one?");
  if (auto ok = read_text(node, "effect", use.effect); !ok) return tl::unexpected(ok.error());
  if (auto ok = read_text(node, "law", use.law); !ok) return tl::unexpected(ok.error());
  if (node.has("parameters")) {
    const JsonNode parameters = node.at("parameters");
    if (!parameters.value->is_object()) return parameters.wrong_type("an object");
    for (const auto& [name, value] : parameters.value->items()) {
      if (!value.is_number()) return parameters.at(name).wrong_type("a number");
      use.parameters.emplace_back(name, value.get<double>());
    }
  }
  const auto axes = read_axes(node);
  if (!axes) return tl::unexpected(axes.error());
  use.axes = *axes;
  if (auto ok = read_boards(node, use.boards); !ok) return tl::unexpected(ok.error());
  const auto instance = rig::instantiate(use);
  if (!instance) return placed(node, use, instance.error());
  return rig::completed(use);
}

Result<rig::EmpiricalTerm> read_unexplained(const JsonNode& node) {
  if (auto ok = only_keys(node, {"driver", "period_s", "at", "dps", "noise_factor", "axes"}); !ok) {
    return tl::unexpected(ok.error());
  }
  for (const char* key : {"driver", "at", node.has("noise_factor") ? "at" : "dps"}) {
    if (!node.has(key)) return node.wrong(Errc::bad_input, fmt::format("no \"{}\"", key));
  }
  rig::EmpiricalTerm term;
  std::string name;
  if (auto ok = read_text(node, "driver", name); !ok) return tl::unexpected(ok.error());
  const auto driver = rig::driver_named(name);
  if (!driver)
    return node.at("driver").wrong(driver.error().code, driver.error().what, driver.error().advice);
  term.driver = *driver;
  const auto at = numbers(node.at("at"), -1e12, 1e12);
  if (!at) return tl::unexpected(at.error());
  term.at = *at;
  if (node.has("dps")) {
    const auto dps = numbers(node.at("dps"), -bias_dps_max, bias_dps_max);
    if (!dps) return tl::unexpected(dps.error());
    term.dps = *dps;
  }
  if (node.has("noise_factor")) {
    const auto factor = numbers(node.at("noise_factor"), 0.0, 1e3);
    if (!factor) return tl::unexpected(factor.error());
    term.noise_factor = *factor;
  }
  if (node.has("period_s")) {
    const auto period = number(node.at("period_s"), 0.0, 1e9);
    if (!period) return tl::unexpected(period.error());
    term.period_s = *period;
  }
  const auto axes = read_axes(node);
  if (!axes) return tl::unexpected(axes.error());
  term.axes = *axes;
  if (auto ok = rig::check(term); !ok) {
    return node.wrong(ok.error().code, ok.error().what, ok.error().advice);
  }
  return term;
}

template <class Item>
Result<void> read_list(const JsonNode& root, const std::string& key,
                       Result<Item> (*read)(const JsonNode&), std::vector<Item>& into) {
  if (!root.has(key)) return {};
  const JsonNode list = root.at(key);
  if (!list.value->is_array()) return list.wrong_type("an array");
  for (std::size_t i = 0; i < list.value->size(); ++i) {
    auto item = read(list.at(i));
    if (!item) return tl::unexpected(item.error());
    into.push_back(std::move(*item));
  }
  return {};
}

Result<rig::RigModel> read_root(const JsonNode& root) {
  if (auto ok = only_keys(
          root, {"format", "name", "parent", "parent_hash", "baseline", "effects", "unexplained"});
      !ok) {
    return tl::unexpected(ok.error());
  }
  std::string format;
  if (auto ok = read_text(root, "format", format); !ok) return tl::unexpected(ok.error());
  if (format != format_name) {
    return root.wrong(Errc::bad_input, fmt::format("format is \"{}\"", format),
                      fmt::format("a rig model says \"format\": \"{}\"", format_name));
  }
  rig::RigModel model;
  model.name.clear();
  for (auto [key, into] : {std::pair{"name", &model.name}, std::pair{"parent", &model.parent},
                           std::pair{"parent_hash", &model.parent_hash}}) {
    if (auto ok = read_text(root, key, *into); !ok) return tl::unexpected(ok.error());
  }
  if (model.name.empty()) return root.wrong(Errc::bad_input, "the model has no \"name\"");
  if (root.has("baseline")) {
    if (auto ok = read_baseline(root.at("baseline"), model.baseline); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  if (auto ok = read_list(root, "effects", read_effect, model.effects); !ok) {
    return tl::unexpected(ok.error());
  }
  if (auto ok = read_list(root, "unexplained", read_unexplained, model.unexplained); !ok) {
    return tl::unexpected(ok.error());
  }
  return model;
}

}  // namespace

Result<rig::RigModel> parse_rig_model(const std::string& text, const std::string& path) {
  try {
    const auto document = nlohmann::json::parse(text);
    return read_root({&document, "", &text, &path});
  } catch (const nlohmann::json::exception& error) {
    return fail(Errc::bad_input, fmt::format("{}: no valid JSON: {}", path, error.what()),
                "gyrocal rig show default --json prints a valid model");
  }
}

std::vector<std::string> rig_model_folders() {
  return {std::begin(places::rig_models), std::end(places::rig_models)};
}

Result<rig::RigModel> read_rig_model(const std::string& path_or_name) {
  std::string path = path_or_name;
  if (path.find('/') == std::string::npos && path.find(".json") == std::string::npos) {
    for (const std::string& folder : rig_model_folders()) {
      const std::string candidate = folder + "/" + path_or_name + ".json";
      struct stat status {};
      if (::stat(candidate.c_str(), &status) == 0) {
        path = candidate;
        break;
      }
    }
  }
  auto text = read_text_file(path);
  if (!text) {
    Error error = text.error();
    error.code = Errc::bad_input;  // what was typed, not the disk
    const auto known = shipped_names(rig_model_folders(), ".json");
    error.advice =
        is_meant(path_or_name, std::vector<std::string_view>(known.begin(), known.end()));
    error.advice += "a path, or the name of a model that gyrocal rig models lists";
    return tl::unexpected(error);
  }
  return parse_rig_model(*text, path);
}

}  // namespace gyrocal
