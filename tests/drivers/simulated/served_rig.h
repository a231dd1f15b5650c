#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "drivers/clocks.h"
#include "drivers/simulated/rig_server.h"
#include "drivers/tty_lock.h"
#include "tests/drivers/simulated/bench_board.h"
#include "tests/drivers/simulated/scratch_folder.h"

namespace gyrocal {

/// A rig on real endpoints under a virtual clock, served turn by turn by the test itself.
class ServedRig {
 public:
  explicit ServedRig(std::size_t boards, const rig::RigModel& model = still_model({17, -3, 5}))
      : rig(model, 1, boards, yinhe_profile(), 1, 20480) {
    RigEndpoints endpoints;
    for (std::size_t index = 0; index < boards; ++index) {
      endpoints.links.push_back(folder / ("board" + std::to_string(index)));
    }
    auto opened = RigServer::open(rig, clock, endpoints, 1.0);
    REQUIRE(opened.has_value());
    server.emplace(*std::move(opened));
  }

  void turn() { REQUIRE(server->serve_once(std::chrono::milliseconds(0)).has_value()); }
  void turn_at(double t_s) {
    clock.sleep_until(at_s(t_s));
    turn();
  }

  ScratchFolder folder;
  VirtualClock clock;
  SimulatedRig rig;
  std::optional<RigServer> server;
};

/// A host's plain open of a board's link.
inline UniqueFd open_port(const std::string& link) {
  UniqueFd port(::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  REQUIRE(port.is_open());
  return port;
}

inline void write_port(const UniqueFd& port, const std::string& packet) {
  const Bytes data = bytes(packet);
  REQUIRE(::write(port.get(), data.data(), data.size()) == static_cast<ssize_t>(data.size()));
}

/// What is there to read, at once.
inline std::string read_port(const UniqueFd& port) {
  std::array<std::uint8_t, 8192> into;
  const ssize_t count = ::read(port.get(), into.data(), into.size());
  return hex(std::span(into).first(static_cast<std::size_t>(count < 0 ? 0 : count)));
}

}  // namespace gyrocal
