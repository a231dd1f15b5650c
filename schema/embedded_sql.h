#pragma once

#include <span>
#include <string_view>

namespace gyrocal {

/// A file of schema/migrations or schema/views, embedded when built.
struct SqlFile {
  std::string_view name;  ///< "001_campaign.sql"
  std::string_view text;
};

/// In the order of their names; the leading number is the schema version they lead to.
[[nodiscard]] std::span<const SqlFile> embedded_migrations();
[[nodiscard]] std::span<const SqlFile> embedded_views();

}  // namespace gyrocal
