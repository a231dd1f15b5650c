#include "schema/backup.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace gyrocal {
namespace {

Result<void> sync_to_disk(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int failed = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  if (failed == 0) return {};
  return fail(Errc::storage, fmt::format("sync {}: {}", path, std::strerror(failed)));
}

/// @return exists, as an error, rather than replacing: link() is the rename that never overwrites.
Result<void> give_name(const std::string& unfinished, const std::string& target) {
  if (::link(unfinished.c_str(), target.c_str()) != 0) {
    const int failed = errno;
    return fail(failed == EEXIST ? Errc::busy : Errc::storage,
                fmt::format("name the copy {}: {}", target, std::strerror(failed)),
                failed == EEXIST ? "choose another name or move that file away" : "");
  }
  const auto folder = std::filesystem::path(target).parent_path();
  return sync_to_disk(folder.empty() ? "." : folder.string());
}

}  // namespace

Result<void> backup(const Database& database, const std::string& target) {
  const std::string unfinished = fmt::format("{}.unfinished-{}", target, ::getpid());
  auto copy = database.prepare("VACUUM INTO ?");
  if (!copy) return tl::unexpected(copy.error());
  auto done = copy->run(unfinished);
  if (done) done = sync_to_disk(unfinished);
  if (done) done = give_name(unfinished, target);
  std::remove(unfinished.c_str());
  if (!done) done.error().what = fmt::format("copy to {}: {}", target, done.error().what);
  return done;
}

}  // namespace gyrocal
