#include "schema/close_cells.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace gyrocal {
namespace {

bool close_numbers(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

bool close_json(const nlohmann::json& a, const nlohmann::json& b, double relative) {
  if (a.is_number() && b.is_number()) {
    return close_numbers(a.get<double>(), b.get<double>(), relative);
  }
  if (!a.is_structured() || a.type() != b.type() || a.size() != b.size()) return a == b;
  // Objects are sorted by key, so that keys and elements can be walked through side by side.
  auto other = b.items().begin();
  for (const auto& [key, value] : a.items()) {
    if (key != other.key() || !close_json(value, other.value(), relative)) return false;
    ++other;
  }
  return true;
}

}  // namespace

bool are_close(const Cell& a, const Cell& b, double relative) {
  if (a == b || relative <= 0 || a.index() != b.index()) return a == b;
  if (const auto* number = std::get_if<double>(&a)) {
    return close_numbers(*number, std::get<double>(b), relative);
  }
  const auto* text = std::get_if<std::string>(&a);
  if (text == nullptr) return false;
  const auto left = nlohmann::json::parse(*text, nullptr, false);
  const auto right = nlohmann::json::parse(std::get<std::string>(b), nullptr, false);
  return !left.is_discarded() && !right.is_discarded() && close_json(left, right, relative);
}

}  // namespace gyrocal
