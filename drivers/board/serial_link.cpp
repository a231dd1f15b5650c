#include "drivers/board/serial_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <libserialport.h>
#include <sys/ioctl.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "drivers/board/pty_shim.h"

namespace gyrocal {
namespace {

namespace fs = std::filesystem;

constexpr unsigned write_timeout_ms = 1000;  // 0 would mean for ever
constexpr int baud = 115200;                 // a CDC-ACM device heeds none

std::string system_text(int code) { return std::generic_category().message(code); }

/// A symbolic link to a pseudo-terminal for as long as it is being opened.
class TemporaryLink {
 public:
  explicit TemporaryLink(const std::string& target) {
    std::string directory = (fs::temp_directory_path(error_) / "gyrocal-XXXXXX").string();
    if (error_ || mkdtemp(directory.data()) == nullptr) return;
    directory_ = directory;
    fs::create_symlink(target, path(), error_);
  }
  TemporaryLink(const TemporaryLink&) = delete;
  TemporaryLink& operator=(const TemporaryLink&) = delete;
  ~TemporaryLink() {
    if (!directory_.empty()) fs::remove_all(directory_, error_);
  }
  [[nodiscard]] fs::path path() const { return directory_ / "pty"; }

 private:
  fs::path directory_;
  std::error_code error_;
};

/// libserialport knows a port by its entry in /sys/class/tty, where a pseudo-terminal has none; but
/// it accepts any symbolic link there, and a path may lead out of that directory again.
std::string through_sys_class_tty(const fs::path& link) { return "/dev/../../.." + link.string(); }

bool configure(sp_port* port) {
  return sp_set_baudrate(port, baud) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, SP_PARITY_NONE) == SP_OK && sp_set_stopbits(port, 1) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK &&
         sp_flush(port, SP_BUF_BOTH) == SP_OK;
}

/// libserialport opens without O_CLOEXEC and without asking for the port alone.
bool keep_to_ourselves(sp_port* port) {
  int fd = -1;
  return sp_get_port_handle(port, &fd) == SP_OK && fcntl(fd, F_SETFD, FD_CLOEXEC) == 0 &&
         ioctl(fd, TIOCEXCL) == 0;
}

}  // namespace

void SerialLink::ClosePort::operator()(sp_port* port) const noexcept {
  // A pseudo-terminal keeps the exclusive mode beyond its last close, for whoever comes next.
  int fd = -1;
  if (sp_get_port_handle(port, &fd) == SP_OK) static_cast<void>(ioctl(fd, TIOCNXCL));
  sp_close(port);
  sp_free_port(port);
}

Result<void> SerialLink::reopen() {
  port_.reset();
  lock_ = UniqueFd{};
  std::error_code missing;
  const fs::path path = fs::canonical(device_, missing);
  if (missing) {
    return lost(Errc::link_lost, fmt::format("find it: {}", missing.message()));
  }
  auto lock = lock_tty(path.string());
  if (!lock) return tl::unexpected(lock.error());
  const bool is_pty = is_pseudo_terminal(lock->get());
  auto port = is_pty ? open_port(through_sys_class_tty(TemporaryLink(path.string()).path()))
                     : open_port(path.string());
  if (!port) return lost(port.error().code, port.error().what);
  lock_ = std::move(*lock);
  port_ = std::move(*port);
  return {};
}

Result<SerialLink::Port> SerialLink::open_port(const std::string& name) {
  sp_port* unopened = nullptr;
  if (sp_get_port_by_name(name.c_str(), &unopened) != SP_OK) {
    return fail(Errc::link_lost, "open it: no serial port of the system");
  }
  if (sp_open(unopened, SP_MODE_READ_WRITE) != SP_OK) {
    const int code = errno;
    sp_free_port(unopened);
    return fail(Errc::link_lost, fmt::format("open it: {}", system_text(code)));
  }
  Port port{unopened};
  if (!configure(port.get()) || !keep_to_ourselves(port.get())) {
    return fail(Errc::link_lost, fmt::format("configure it: {}", system_text(errno)));
  }
  return port;
}

Result<std::size_t> SerialLink::read(std::span<std::uint8_t> into) {
  if (!port_) return lost(Errc::link_lost, "read: it is not open");
  const int count = sp_nonblocking_read(port_.get(), into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  const bool is_alive = count == 0 && sp_input_waiting(port_.get()) >= 0;
  if (is_alive) return std::size_t{0};
  return lost(Errc::link_lost, fmt::format("read: {}", system_text(errno)));
}

Result<void> SerialLink::write(std::span<const std::uint8_t> bytes) {
  if (!port_) return lost(Errc::link_lost, "write: it is not open");
  const int count = sp_blocking_write(port_.get(), bytes.data(), bytes.size(), write_timeout_ms);
  if (count < 0) return lost(Errc::link_lost, fmt::format("write: {}", system_text(errno)));
  if (static_cast<std::size_t>(count) == bytes.size()) return {};
  return lost(Errc::timeout, fmt::format("write {} bytes: it took {} in {} ms", bytes.size(), count,
                                         write_timeout_ms));
}

tl::unexpected<Error> SerialLink::lost(Errc code, const std::string& what) {
  port_.reset();
  lock_ = UniqueFd{};
  return fail(code, fmt::format("{}: {}", device_, what), "is it plugged in?");
}

}  // namespace gyrocal
