#include "drivers/simulated/board_pty.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pty.h>
#include <sys/inotify.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace gyrocal {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t packet_bytes_max = 4096;

tl::unexpected<Error> failed(const char* doing, const std::string& what, int code) {
  return fail(Errc::storage, fmt::format("{} {}: {}", doing, what, std::strerror(code)),
              "is the folder ours to write, and /dev/pts mounted?");
}

/// Points `link` to `target` at once: whoever looks sees the old one or the new one.
Result<void> point(const std::string& link, const std::string& target) {
  std::error_code error;
  const auto kind = fs::symlink_status(link, error).type();
  if (kind != fs::file_type::symlink && kind != fs::file_type::not_found) {
    return fail(Errc::busy, fmt::format("{}: stands there and is no link", link),
                "choose another link directory or device name");
  }
  const std::string fresh = fmt::format("{}.{}", link, ::getpid());
  if (::symlink(target.c_str(), fresh.c_str()) != 0) return failed("link", fresh, errno);
  if (::rename(fresh.c_str(), link.c_str()) != 0) {
    const int code = errno;
    ::unlink(fresh.c_str());
    return failed("rename to", link, code);
  }
  return {};
}

bool is_open(int master) {
  pollfd state{master, POLLIN, 0};
  ::poll(&state, 1, 0);
  return (state.revents & POLLHUP) == 0;
}

}  // namespace

BoardPty::BoardPty(SimulatedBoard& board, std::string link)
    : board_(&board), link_(std::move(link)) {}

Result<BoardPty> BoardPty::open(SimulatedBoard& board, const std::string& link, Instant now) {
  BoardPty pty(board, link);
  if (const auto attached = pty.attach(now); !attached) return tl::unexpected(attached.error());
  return pty;
}

BoardPty::~BoardPty() { detach(); }

Result<BoardPty::Terminal> BoardPty::new_terminal() {
  termios raw{};
  ::cfmakeraw(&raw);
  raw.c_cflag |= CREAD | CLOCAL;
  ::cfsetspeed(&raw, B115200);
  int master = -1;
  int slave = -1;
  std::array<char, 128> name{};
  if (::openpty(&master, &slave, name.data(), &raw, nullptr) != 0) {
    return failed("open", "a pseudo-terminal", errno);
  }
  const UniqueFd closed_again(slave);  // a slave we kept open would hide that the host closes it
  Terminal terminal{UniqueFd(master), UniqueFd(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
                    name.data()};
  if (::fcntl(master, F_SETFL, O_NONBLOCK) != 0 || ::fcntl(master, F_SETFD, FD_CLOEXEC) != 0 ||
      ::inotify_add_watch(terminal.opened.get(), name.data(), IN_OPEN) < 0) {
    return failed("watch", name.data(), errno);
  }
  return terminal;
}

Result<void> BoardPty::attach(Instant now) {
  auto terminal = new_terminal();
  if (!terminal) return tl::unexpected(terminal.error());
  if (auto linked = point(link_, terminal->name); !linked) return linked;
  terminal_ = *std::move(terminal);
  appearance_ = board_->appearance();
  host_open_ = false;
  board_->host_closes(now);
  return {};
}

void BoardPty::detach() {
  if (!terminal_.master.is_open()) return;
  std::error_code gone;
  if (fs::read_symlink(link_, gone) == terminal_.name) ::unlink(link_.c_str());
  terminal_ = Terminal{};
}

void BoardPty::watch(std::vector<pollfd>& into) const {
  if (!terminal_.master.is_open()) return;
  into.push_back({terminal_.opened.get(), POLLIN, 0});
  // A terminal nobody has open is always "ready" (hung up): the watch above wakes us instead.
  if (!host_open_) return;
  const bool stuck = !board_->output().empty();
  into.push_back(
      {terminal_.master.get(), static_cast<short>(stuck ? POLLIN | POLLOUT : POLLIN), 0});
}

Result<void> BoardPty::serve(Instant now) {
  board_->advance(now);
  if (!board_->present() || board_->appearance() != appearance_) detach();
  if (!terminal_.master.is_open()) return board_->present() ? attach(now) : Result<void>{};
  if (auto noticed = notice_host(now); !noticed) return noticed;
  if (!host_open_) return {};
  hear(now);
  speak();
  return {};
}

Result<void> BoardPty::notice_host(Instant now) {
  std::array<char, 4096> events;
  bool opened = false;
  while (::read(terminal_.opened.get(), events.data(), events.size()) > 0) opened = true;
  const bool open = is_open(terminal_.master.get());
  if (open && !host_open_) board_->host_opens(now);
  const bool closed = !open && (host_open_ || opened);
  host_open_ = open;
  if (!closed) return {};
  hear(now);  // what the host wrote before it closed
  board_->host_closes(now);
  return replace_terminal();
}

Result<void> BoardPty::replace_terminal() {
  auto fresh = new_terminal();
  if (!fresh) return tl::unexpected(fresh.error());
  if (auto linked = point(link_, fresh->name); !linked) return linked;
  // Whoever opened the old one before the link moved keeps it.
  if (is_open(terminal_.master.get())) return point(link_, terminal_.name);
  terminal_ = *std::move(fresh);
  return {};
}

void BoardPty::hear(Instant now) {
  std::array<std::uint8_t, packet_bytes_max> packet;
  const ssize_t count = ::read(terminal_.master.get(), packet.data(), packet.size());
  if (count > 0) board_->receive(std::span(packet).first(static_cast<std::size_t>(count)), now);
}

void BoardPty::speak() {
  while (!board_->output().empty()) {
    const auto output = board_->output();
    const ssize_t count = ::write(terminal_.master.get(), output.data(), output.size());
    if (count <= 0) return;  // full: the board waits
    board_->take(static_cast<std::size_t>(count));
  }
}

}  // namespace gyrocal
