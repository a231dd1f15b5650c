#include "daemon/runner/disk_room.h"

#include <filesystem>
#include <system_error>

namespace gyrocal::runner {

std::optional<std::uintmax_t> disk_room(const std::string& database) {
  std::error_code unknown;
  const auto file = std::filesystem::absolute(database.empty() ? "." : database, unknown);
  if (unknown) return std::nullopt;
  const auto space = std::filesystem::space(file.parent_path(), unknown);
  if (unknown) return std::nullopt;
  return space.available;
}

}  // namespace gyrocal::runner
