#include "drivers/tty_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace gyrocal {
namespace {

/// "process 1234 (gyrocald)", from the kernel's list of locks.
std::string holder_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return "another process";
  const std::string inode =
      fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, way, access, pid, file;
    words >> number >> kind >> way >> access >> pid >> file;
    if (kind != "FLOCK" || file != inode) continue;
    std::string name = "unknown";
    std::getline(std::ifstream(fmt::format("/proc/{}/comm", pid)), name);
    return fmt::format("process {} ({})", pid, name);
  }
  return "another process";
}

}  // namespace

UniqueFd& UniqueFd::operator=(UniqueFd&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

UniqueFd::~UniqueFd() {
  if (fd_ >= 0) close(fd_);
}

Result<UniqueFd> lock_tty(const std::string& path) {
  UniqueFd fd{open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  const int open_error = fd.is_open() ? 0 : errno;
  const bool is_held = open_error == EBUSY ||  // by its holder's TIOCEXCL
                       (fd.is_open() && flock(fd.get(), LOCK_EX | LOCK_NB) != 0);
  if (is_held) {
    return fail(Errc::busy, fmt::format("{} is held by {}", path, holder_of(path)),
                "end the other program, or give each its own device");
  }
  if (!fd.is_open()) {
    return fail(Errc::link_lost,
                fmt::format("open {}: {}", path, std::generic_category().message(open_error)),
                open_error == EACCES ? "is this user in the group dialout?" : "is it plugged in?");
  }
  return fd;
}

}  // namespace gyrocal
