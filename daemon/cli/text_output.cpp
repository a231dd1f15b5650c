#include "daemon/cli/text_output.h"

#include <fmt/core.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace gyrocal::cli {

Result<void> write_text_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text << std::flush;
  if (file) return {};
  const int code = errno;
  return fail(Errc::storage,
              fmt::format("cannot write {}: {}", path, std::generic_category().message(code)),
              "check path and space");
}

}  // namespace gyrocal::cli
