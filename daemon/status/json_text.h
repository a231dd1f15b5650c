#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gyrocal::status {

/// On one line. Texts of devices may hold any byte; a client shall get valid JSON all the same.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace gyrocal::status
