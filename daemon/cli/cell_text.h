#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "schema/sqlite.h"

namespace gyrocal::cli {

/// A row as a JSON object: column name to value, NULL to null.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<std::string>& columns,
                                             const std::vector<Cell>& row);

/// A row as a CSV line without its end: shortest numbers that read back to the same bits, nothing
/// for NULL, quotes where a text needs them (RFC 4180).
[[nodiscard]] std::string to_csv(const std::vector<Cell>& row);

}  // namespace gyrocal::cli
