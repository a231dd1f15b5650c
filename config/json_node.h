#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

/// One value of a JSON document with what is needed to say where it stands. Points into document,
/// text and path, which must outlive it.
struct JsonNode {
  const nlohmann::json* value;
  std::string pointer;
  const std::string* text;
  const std::string* path;

  [[nodiscard]] JsonNode at(const std::string& key) const;
  [[nodiscard]] JsonNode at(std::size_t i) const;
  [[nodiscard]] bool has(const std::string& key) const { return value->contains(key); }

  /// "FILE:LINE: /pointer: what".
  [[nodiscard]] tl::unexpected<Error> wrong(Errc code, const std::string& what,
                                            const std::string& advice = {}) const;
  [[nodiscard]] tl::unexpected<Error> wrong_type(const char* expected) const;
};

/// bad_input if it is no object; unknown_name, with the list, at the first key that is not known.
[[nodiscard]] Result<void> only_keys(const JsonNode& object, const std::set<std::string>& known);

/// bad_input, not_finite or out_of_range.
[[nodiscard]] Result<double> number(const JsonNode& node, double low, double high);
[[nodiscard]] Result<std::vector<double>> numbers(const JsonNode& node, double low, double high);

/// Reads object[key] into `into` if it is there; bad_input if it is no string.
[[nodiscard]] Result<void> read_text(const JsonNode& object, const std::string& key,
                                     std::string& into);

}  // namespace gyrocal
