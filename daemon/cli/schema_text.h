#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "schema/catalogue.h"

namespace gyrocal::cli {

/// docs/database.md: how to open the file, a picture of what belongs to what, every table and view.
[[nodiscard]] std::string schema_markdown(const Catalogue& catalogue);

/// {"schema_version", "tables": [{"name", "kind", "comment", "columns": [...]}]}
[[nodiscard]] nlohmann::ordered_json schema_json(const Catalogue& catalogue);

}  // namespace gyrocal::cli
