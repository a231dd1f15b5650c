#include <sys/ioctl.h>

#include "tests/drivers/simulated/served_rig.h"

using namespace gyrocal;

namespace {

std::string say(ServedRig& rig, const UniqueFd& port, const std::string& packet) {
  write_port(port, packet);
  rig.turn();
  return read_port(port);
}

void start_gyro(ServedRig& rig, const UniqueFd& port) {
  REQUIRE(say(rig, port, "20 01 00") == "80 01 00");
  REQUIRE(say(rig, port, "20 05 50 28 18 00 00") == "80 01 50");
  REQUIRE(say(rig, port, "20 01 52") == "80 01 52");
}

}  // namespace

TEST_CASE("a board at a pseudo-terminal answers to open, write and read", "[simulated][pty]") {
  ServedRig rig(1);
  const auto port = open_port(rig.folder / "board0");
  start_gyro(rig, port);
  rig.turn_at(0.02);
  CHECK(read_port(port) == "40 09 52 00 01 00 11 ff fd 00 05");
}

TEST_CASE("no byte is lost or changed on the terminal: 11, 13, 03, 04, 0d, 0a, ff, 00",
          "[simulated][pty]") {
  ServedRig rig(1, still_model({0x1113, 0x0304, 0x0d0a}));
  const auto port = open_port(rig.folder / "board0");
  start_gyro(rig, port);
  rig.turn_at(0.02);
  CHECK(read_port(port) == "40 09 52 00 01 0f ff 03 04 0d 0a");  // 0x1113 is beyond the ADC
}

TEST_CASE("two commands in one write are one packet, and wrong", "[simulated][pty]") {
  ServedRig rig(1);
  const auto port = open_port(rig.folder / "board0");
  CHECK(say(rig, port, "20 01 00 20 01 13") == "c0 02 00 04");
}

TEST_CASE("two boards have two terminals that know nothing of each other", "[simulated][pty]") {
  ServedRig rig(2);
  const auto first = open_port(rig.folder / "board0");
  const auto second = open_port(rig.folder / "board1");
  start_gyro(rig, first);
  CHECK(say(rig, second, "20 01 51") == "c0 02 51 05");
  rig.turn_at(0.02);
  CHECK(read_port(first) == "40 09 52 00 01 00 11 ff fd 00 05");
  CHECK(read_port(second).empty());
}

TEST_CASE("a host that closes and opens again finds one stale frame, then fresh ones",
          "[simulated][pty]") {
  ServedRig rig(1);
  auto port = open_port(rig.folder / "board0");
  start_gyro(rig, port);
  rig.turn_at(1.0);  // 50 frames, never read
  port = UniqueFd{};
  rig.turn();
  rig.turn_at(60);
  port = open_port(rig.folder / "board0");
  rig.turn();
  CHECK(read_port(port) == "40 09 52 00 33 00 11 ff fd 00 05");  // number 51, of 1.02 s
  rig.turn_at(60.02);
  CHECK(read_port(port) == "40 09 52 00 34 00 11 ff fd 00 05");
}

TEST_CASE("a port left in exclusive mode can be opened again", "[simulated][pty]") {
  ServedRig rig(1);
  auto port = open_port(rig.folder / "board0");
  rig.turn();
  REQUIRE(::ioctl(port.get(), TIOCEXCL) == 0);
  port = UniqueFd{};
  rig.turn();
  int exclusive = -1;
  port = open_port(rig.folder / "board0");
  REQUIRE(::ioctl(port.get(), TIOCGEXCL, &exclusive) == 0);
  CHECK(exclusive == 0);
  CHECK(say(rig, port, "20 01 00") == "80 01 00");
}

TEST_CASE("a host that reads nothing makes the board wait, without a gap in the counter",
          "[simulated][pty]") {
  ServedRig rig(1);
  const auto port = open_port(rig.folder / "board0");
  start_gyro(rig, port);
  for (double t_s = 1; t_s <= 3600; ++t_s) rig.turn_at(t_s);
  unsigned last = 0;
  Bytes all;
  for (int empty = 0; empty < 3; ++empty) {
    for (;;) {
      const Bytes more = bytes(read_port(port));
      if (more.empty()) break;
      all.insert(all.end(), more.begin(), more.end());
      empty = 0;
      rig.turn();
    }
    rig.turn();
  }
  REQUIRE(all.size() % 11 == 0);
  CHECK(all.size() < 4000 * 11);  // of 180000 due
  for (std::size_t at = 0; at < all.size(); at += 11) {
    const unsigned counter = all[at + 3] * 256U + all[at + 4];
    REQUIRE(counter == last + 1);
    last = counter;
  }
}

TEST_CASE("an unplugged board takes its link with it, and comes back under the same name",
          "[simulated][pty]") {
  ServedRig rig(1);
  const auto port = open_port(rig.folder / "board0");
  start_gyro(rig, port);
  rig.rig.board(0).unplug(rig.clock.now());
  rig.turn();
  CHECK(rig.folder.entries() == 0);
  pollfd state{port.get(), POLLIN, 0};
  CHECK(::poll(&state, 1, 0) == 1);
  CHECK((state.revents & POLLHUP) != 0);
  rig.rig.board(0).plug_in(rig.clock.now());
  rig.turn();
  const auto again = open_port(rig.folder / "board0");
  rig.turn();
  CHECK(say(rig, again, "20 01 51") == "c0 02 51 05");
}

TEST_CASE("the command Reset is an unplugging too, for a second", "[simulated][pty]") {
  ServedRig rig(1);
  const auto port = open_port(rig.folder / "board0");
  REQUIRE(say(rig, port, "20 01 00") == "80 01 00");
  CHECK(say(rig, port, "20 01 02") == "80 01 02");
  rig.turn_at(5.5);
  CHECK(rig.folder.entries() == 0);
  rig.turn_at(6.5);
  CHECK(rig.folder.entries() == 1);
  const auto again = open_port(rig.folder / "board0");
  rig.turn();
  CHECK(say(rig, again, "20 01 00") == "80 01 00");
}

TEST_CASE("no link is left when the rig ends", "[simulated][pty]") {
  ServedRig rig(2);
  CHECK(rig.folder.entries() == 2);
  rig.server.reset();
  CHECK(rig.folder.entries() == 0);
}

TEST_CASE("a folder made for the links goes with them; one that was there stays",
          "[simulated][pty]") {
  ScratchFolder folder;
  VirtualClock clock;
  SimulatedRig rig({}, 1, 1, yinhe_profile(), 1);
  {
    const auto server = RigServer::open(rig, clock, {"127.0.0.1", 0, {folder / "made/board0"}}, 1);
    REQUIRE(server.has_value());
    CHECK(std::filesystem::is_symlink(folder / "made/board0"));
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("a link that a killed rig left behind is replaced; a file is not", "[simulated][pty]") {
  ScratchFolder folder;
  VirtualClock clock;
  SimulatedRig rig({}, 1, 1, yinhe_profile(), 1);
  const RigEndpoints endpoints{"127.0.0.1", 0, {folder / "board0"}};
  SECTION("link") {
    std::filesystem::create_symlink("/dev/pts/99999", folder / "board0");
    CHECK(RigServer::open(rig, clock, endpoints, 1).has_value());
  }
  SECTION("file") {
    std::filesystem::create_directory(folder / "board0");
    const auto server = RigServer::open(rig, clock, endpoints, 1);
    REQUIRE_FALSE(server.has_value());
    CHECK(server.error().code == Errc::busy);
    CHECK(server.error().what == folder / "board0" + ": stands there and is no link");
  }
}

TEST_CASE("two rigs do not share a folder of links", "[simulated][pty]") {
  ServedRig first(1);
  SimulatedRig rig({}, 1, 1, yinhe_profile(), 1);
  const auto second =
      RigServer::open(rig, first.clock, {"127.0.0.1", 0, {first.folder / "board9"}}, 1);
  REQUIRE_FALSE(second.has_value());
  CHECK(second.error().code == Errc::busy);
}
