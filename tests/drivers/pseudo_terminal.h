#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "drivers/link.h"
#include "drivers/tty_lock.h"

namespace gyrocal::test {

/// The device's end of a pseudo-terminal; its other end is a port for the driver.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(grantpt(master_.get()) == 0);
    REQUIRE(unlockpt(master_.get()) == 0);
    std::array<char, 64> name;
    REQUIRE(ptsname_r(master_.get(), name.data(), name.size()) == 0);
    port = name.data();
    keeps_open_ = UniqueFd{open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    REQUIRE(keeps_open_.is_open());
  }

  void send(const Bytes& bytes) {
    REQUIRE(::write(master_.get(), bytes.data(), bytes.size()) ==
            static_cast<ssize_t>(bytes.size()));
  }
  /// What the driver wrote; waits for at least one byte.
  Bytes receive() {
    pollfd ready{master_.get(), POLLIN, 0};
    REQUIRE(poll(&ready, 1, 5000) == 1);
    Bytes bytes(4096);
    const ssize_t count = ::read(master_.get(), bytes.data(), bytes.size());
    REQUIRE(count > 0);
    bytes.resize(static_cast<std::size_t>(count));
    return bytes;
  }
  void unplug() { master_ = UniqueFd{}; }

  std::string port;

 private:
  UniqueFd master_;
  UniqueFd keeps_open_;  ///< a port that nobody has open reads as gone on this end
};

}  // namespace gyrocal::test
