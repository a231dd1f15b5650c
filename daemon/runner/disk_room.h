#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gyrocal::runner {

/// Bytes an ordinary user may still write on the disk a database lies on, or will lie on; nothing
/// if that cannot be found out.
[[nodiscard]] std::optional<std::uintmax_t> disk_room(const std::string& database);

}  // namespace gyrocal::runner
