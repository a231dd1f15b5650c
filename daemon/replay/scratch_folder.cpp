#include "daemon/replay/scratch_folder.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace gyrocal::replay {

Result<ScratchFolder> ScratchFolder::make() {
  std::error_code none;
  const auto base = std::filesystem::temp_directory_path(none);
  std::string name = (base / "gyrocal-replay-XXXXXX").string();
  if (none || ::mkdtemp(name.data()) == nullptr) {
    const int failed = errno;
    return fail(Errc::storage,
                fmt::format("make a temporary folder in {}: {}", base.string(),
                            none ? none.message() : std::strerror(failed)),
                "set TMPDIR to a folder with room");
  }
  return ScratchFolder(name);
}

ScratchFolder::~ScratchFolder() {
  if (path_.empty()) return;
  std::error_code left_behind;  // a temporary folder is nobody's loss
  std::filesystem::remove_all(path_, left_behind);
}

}  // namespace gyrocal::replay
