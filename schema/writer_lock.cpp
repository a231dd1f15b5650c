#include "schema/writer_lock.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace gyrocal {
namespace {

std::string holder(int file) {
  std::array<char, 32> text{};
  const auto got = ::pread(file, text.data(), text.size() - 1, 0);
  return got > 0 ? std::string(text.data(), static_cast<std::size_t>(got)) : "unknown";
}

/// The holder removes the file when it ends; a lock on a file no longer there locks nobody out.
bool still_there(int file, const std::string& path) {
  struct stat ours {};
  struct stat there {};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 &&
         ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
}

}  // namespace

Result<WriterLock> WriterLock::take(const std::string& database_path) {
  const std::string path = database_path + "-writer";
  for (;;) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0) {
      const int failed = errno;
      return fail(Errc::storage, fmt::format("lock {}: {}", path, std::strerror(failed)),
                  "a writer needs the database's folder writable");
    }
    WriterLock lock(file, path);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
      const int failed = errno;
      lock.path_.clear();  // not ours to remove
      if (failed == EINTR) continue;
      if (failed != EWOULDBLOCK) {
        return fail(Errc::storage, fmt::format("lock {}: {}", path, std::strerror(failed)));
      }
      return fail(Errc::busy,
                  fmt::format("{}: process {} is writing to it", database_path, holder(file)),
                  "wait for it to end, or stop it");
    }
    if (!still_there(file, path)) {
      lock.path_.clear();
      continue;
    }
    const auto pid = std::to_string(::getpid());
    if (::ftruncate(file, 0) != 0 || ::pwrite(file, pid.data(), pid.size(), 0) < 0) {
      // On a full disk the lock holds all the same; only its message loses the number.
    }
    return lock;
  }
}

WriterLock::WriterLock(WriterLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)) {}

WriterLock& WriterLock::operator=(WriterLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  return *this;
}

WriterLock::~WriterLock() {
  if (file_ < 0) return;
  if (!path_.empty()) ::unlink(path_.c_str());  // while still locked: nobody else can hold it
  ::close(file_);
}

}  // namespace gyrocal
