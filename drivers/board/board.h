#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

struct BoardIdentity {
  std::string mcu_id;            ///< 24 hex digits, the STM32's unique id
  std::string firmware_version;  ///< "iNEMO Firmware_Version_2.2"
  std::string hardware_version;  ///< "iNEMO V2 Hardware_Version_1"
  bool operator==(const BoardIdentity&) const = default;
};

/// What the board streams. The rate must be one the firmware knows: 1 10 25 30 50 100 400 Hz.
struct BoardMode {
  int sample_rate_hz = 50;
  bool accelerometer = false;
  bool temperature = true;
  bool operator==(const BoardMode&) const = default;
};

/// Counters since start(); all only grow.
struct BoardTally {
  std::uint64_t frames = 0;
  std::uint64_t missing = 0;  ///< frames the counter says were sent and never came
  std::uint64_t duplicates = 0;
  std::uint64_t bytes_skipped = 0;  ///< bytes that belonged to no frame
  std::uint64_t rejected = 0;       ///< frames with impossible values
  std::uint64_t restarts = 0;       ///< the counter started again: the board was reset
  std::uint64_t ticks_missed = 0;   ///< samples the board slept through: no gap in its counter
  bool operator==(const BoardTally&) const = default;
};

/// One iNEMO V2 board on a serial link.
class Board {
 public:
  virtual ~Board() = default;
  /// Connects, stops whatever streams, identifies, sets the mode and reads it back. Takes up to a
  /// few seconds of campaign time.
  /// @return timeout, link_lost, refused (NACK), mismatch (no iNEMO V2, mode not taken), busy.
  [[nodiscard]] virtual Result<BoardIdentity> open(const BoardMode& mode) = 0;
  [[nodiscard]] virtual Result<void> start() = 0;
  [[nodiscard]] virtual Result<void> stop() = 0;
  /// Appends what has arrived since the last call, in order; at once, never waits.
  /// BoardSample::t_ns is in time since the epoch of the board's Clock, and only grows. The newest
  /// frame may stay back for two sample periods: nothing but what follows it proves it whole.
  /// @return link_lost when the board is gone: open() and start() again, with back-off.
  [[nodiscard]] virtual Result<void> drain(std::vector<BoardSample>& into) = 0;
  [[nodiscard]] virtual const BoardTally& tally() const = 0;
};

}  // namespace gyrocal
