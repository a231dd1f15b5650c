#include "drivers/board/serial_link.h"

#include <sys/ioctl.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>

#include "drivers/board/pty_shim.h"
#include "tests/drivers/pseudo_terminal.h"

using namespace gyrocal;
using gyrocal::test::PseudoTerminal;

namespace {

/// Reads until `count` bytes have come; the kernel passes them on at once.
Bytes read_bytes(SerialLink& link, std::size_t count) {
  Bytes bytes;
  std::array<std::uint8_t, 512> chunk;
  for (int i = 0; i < 10'000'000 && bytes.size() < count; ++i) {
    const auto got = link.read(chunk);
    REQUIRE(got);
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(*got));
  }
  return bytes;
}

std::filesystem::path fresh_directory() {
  std::string name = (std::filesystem::temp_directory_path() / "gyrocal-test-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  return name;
}

}  // namespace

TEST_CASE("every byte value passes a port both ways", "[serial]") {
  PseudoTerminal device;
  SerialLink link(device.port);
  REQUIRE(link.reopen());
  Bytes all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<std::uint8_t>(i));
  device.send(all);
  CHECK(read_bytes(link, 256) == all);
  REQUIRE(link.write(all));
  CHECK(device.receive() == all);
}

TEST_CASE("nothing there is no error", "[serial]") {
  PseudoTerminal device;
  SerialLink link(device.port);
  REQUIRE(link.reopen());
  std::array<std::uint8_t, 8> chunk;
  CHECK(link.read(chunk) == 0u);
}

TEST_CASE("an unplugged device is a lost link, not silence", "[serial]") {
  PseudoTerminal device;
  SerialLink link(device.port);
  REQUIRE(link.reopen());
  device.unplug();
  std::array<std::uint8_t, 8> chunk;
  const auto got = link.read(chunk);
  REQUIRE_FALSE(got);
  CHECK(got.error().code == Errc::link_lost);
  CHECK_THAT(got.error().what, Catch::StartsWith(device.port + ": read: "));
  CHECK(link.write(Bytes{1}).error().code == Errc::link_lost);
  CHECK(link.reopen().error().code == Errc::link_lost);
}

TEST_CASE("a device that comes back under another number is found by its stable name", "[serial]") {
  const auto directory = fresh_directory();
  const auto name = directory / "board0";
  PseudoTerminal first;
  std::filesystem::create_symlink(first.port, name);
  SerialLink link(name);
  REQUIRE(link.reopen());
  PseudoTerminal second;
  first.unplug();
  std::filesystem::remove(name);
  std::filesystem::create_symlink(second.port, name);
  std::array<std::uint8_t, 8> chunk;
  CHECK_FALSE(link.read(chunk));
  REQUIRE(link.reopen());
  second.send({0x40});
  CHECK(read_bytes(link, 1) == Bytes{0x40});
  std::filesystem::remove_all(directory);
}

TEST_CASE("opening leaves no temporary link behind", "[serial]") {
  const auto directory = fresh_directory();
  setenv("TMPDIR", directory.c_str(), 1);
  PseudoTerminal device;
  SerialLink link(device.port);
  CHECK(link.reopen());
  CHECK(std::filesystem::is_empty(directory));
  unsetenv("TMPDIR");
  std::filesystem::remove_all(directory);
}

TEST_CASE("a port has one user, and a second one is told who it is", "[serial]") {
  PseudoTerminal device;
  SerialLink first(device.port);
  REQUIRE(first.reopen());
  SerialLink second(device.port);
  const auto opened = second.reopen();
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == Errc::busy);
  CHECK_THAT(opened.error().what, Catch::Contains(device.port + " is held by process " +
                                                  std::to_string(getpid()) + " (test_board)"));
  device.send({7});
  CHECK(read_bytes(first, 1) == Bytes{7});  // and the first one goes on
}

TEST_CASE("a child process inherits no port", "[serial]") {
  PseudoTerminal device;
  SerialLink link(device.port);
  REQUIRE(link.reopen());
  const std::string list = "ls -l /proc/self/fd | grep -c " + device.port;
  FILE* const child = popen(list.c_str(), "r");
  REQUIRE(child != nullptr);
  std::array<char, 16> count{};
  REQUIRE(fgets(count.data(), static_cast<int>(count.size()), child) != nullptr);
  pclose(child);
  CHECK(std::string(count.data()) == "0\n");
}

TEST_CASE("what is no serial port is refused with what it is called", "[serial]") {
  SerialLink absent("/dev/serial/by-id/usb-nobody");
  const auto opened = absent.reopen();
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == Errc::link_lost);
  CHECK(opened.error().what == "/dev/serial/by-id/usb-nobody: find it: No such file or directory");
  SerialLink file("/etc/passwd");
  CHECK(file.reopen().error().code == Errc::link_lost);
  SerialLink null("/dev/null");
  CHECK(null.reopen().error().code == Errc::link_lost);
  std::array<std::uint8_t, 8> chunk;
  CHECK(null.read(chunk).error().what == "/dev/null: read: it is not open");
}

TEST_CASE("modem lines are a pretence on pseudo-terminals only", "[serial]") {
  PseudoTerminal device;
  const UniqueFd slave{open(device.port.c_str(), O_RDWR | O_NOCTTY)};
  CHECK(is_pseudo_terminal(slave.get()));
  int lines = -1;
  CHECK(ioctl(slave.get(), TIOCMGET, &lines) == 0);
  CHECK(lines == 0);
  const UniqueFd null{open("/dev/null", O_RDWR)};
  CHECK_FALSE(is_pseudo_terminal(null.get()));
  errno = 0;
  CHECK(ioctl(null.get(), TIOCMGET, &lines) == -1);
  CHECK(errno == ENOTTY);
  winsize size{};
  CHECK(ioctl(slave.get(), TIOCGWINSZ, &size) == 0);
}
