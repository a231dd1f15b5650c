#include "config/json_node.h"

#include <fmt/core.h>

#include <cmath>

#include "config/json_line.h"

namespace gyrocal {

JsonNode JsonNode::at(const std::string& key) const {
  return {&(*value)[key], pointer + "/" + key, text, path};
}

JsonNode JsonNode::at(std::size_t i) const {
  return {&(*value)[i], fmt::format("{}/{}", pointer, i), text, path};
}

tl::unexpected<Error> JsonNode::wrong(Errc code, const std::string& what,
                                      const std::string& advice) const {
  return fail(code,
              fmt::format("{}:{}: {}: {}", *path, json_line(*text, pointer),
                          pointer.empty() ? "/" : pointer, what),
              advice);
}

tl::unexpected<Error> JsonNode::wrong_type(const char* expected) const {
  return wrong(Errc::bad_input, fmt::format("{}, but {} expected", value->type_name(), expected));
}

Result<void> only_keys(const JsonNode& object, const std::set<std::string>& known) {
  if (!object.value->is_object()) return object.wrong_type("an object");
  for (const auto& [key, value] : object.value->items()) {
    if (known.contains(key)) continue;
    std::string list;
    for (const auto& name : known) list += (list.empty() ? "known: " : ", ") + name;
    return object.at(key).wrong(Errc::unknown_name, "unknown key", list);
  }
  return {};
}

Result<double> number(const JsonNode& node, double low, double high) {
  if (!node.value->is_number()) return node.wrong_type("a number");
  const double value = node.value->get<double>();
  if (!std::isfinite(value)) return node.wrong(Errc::not_finite, "not a finite number");
  if (value < low || value > high) {
    return node.wrong(Errc::out_of_range, fmt::format("{} is out of range", value),
                      fmt::format("allowed: {}..{}", low, high));
  }
  return value;
}

Result<void> read_text(const JsonNode& object, const std::string& key, std::string& into) {
  if (!object.has(key)) return {};
  const JsonNode node = object.at(key);
  if (!node.value->is_string()) return node.wrong_type("a string");
  into = node.value->get<std::string>();
  return {};
}

Result<std::vector<double>> numbers(const JsonNode& node, double low, double high) {
  if (!node.value->is_array()) return node.wrong_type("an array of numbers");
  std::vector<double> values;
  for (std::size_t i = 0; i < node.value->size(); ++i) {
    const auto value = number(node.at(i), low, high);
    if (!value) return tl::unexpected(value.error());
    values.push_back(*value);
  }
  return values;
}

}  // namespace gyrocal
