#include "daemon/cli/one_of.h"

#include <fmt/ranges.h>

#include "compensation/values/nearest_name.h"

namespace gyrocal::cli {

std::string one_of(const std::string& asked, const char* what,
                   const std::vector<std::string>& names) {
  return fmt::format("{}{}: {}",
                     is_meant(asked, std::vector<std::string_view>(names.begin(), names.end())),
                     what, fmt::join(names, ", "));
}

}  // namespace gyrocal::cli
