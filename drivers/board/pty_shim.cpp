#include "drivers/board/pty_shim.h"

#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

// libserialport 0.1.1 reads and sets the modem lines of every port it opens. A pseudo-terminal has
// none: the kernel answers ENOTTY, and sp_open gives up. So that simulated boards go through the
// same driver as real ones, this program has its own `ioctl`, which the dynamic linker prefers to
// the C library's, for libserialport too. It says "done" in that one case: modem lines, ENOTTY, and
// a pseudo-terminal. On a real port it is the system call and nothing else.

namespace gyrocal {

bool is_pseudo_terminal(int fd) noexcept {
  constexpr unsigned slave_major_first = 136;  // Documentation/admin-guide/devices.txt
  constexpr unsigned slave_major_last = 143;
  struct stat status {};
  if (fstat(fd, &status) != 0 || !S_ISCHR(status.st_mode)) return false;
  return major(status.st_rdev) >= slave_major_first && major(status.st_rdev) <= slave_major_last;
}

namespace {

bool concerns_modem_lines(unsigned long request) noexcept {
  return request == TIOCMGET || request == TIOCMBIS || request == TIOCMBIC || request == TIOCMSET;
}

}  // namespace
}  // namespace gyrocal

extern "C" __attribute__((visibility("default"))) int ioctl(int fd, unsigned long request,
                                                            ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  const auto result = static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
  if (result == 0 || errno != ENOTTY || !gyrocal::concerns_modem_lines(request)) return result;
  if (!gyrocal::is_pseudo_terminal(fd)) {
    errno = ENOTTY;  // fstat may have changed it
    return result;
  }
  if (request == TIOCMGET) *static_cast<int*>(argument) = 0;
  return 0;
}
