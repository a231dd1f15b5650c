#pragma once

#include <array>
#include <cstdint>

#include "compensation/rig/random.h"
#include "compensation/rig/rig_board.h"

namespace gyrocal {

/// The board's LSM303DLH at 2 g, raw: 12 bits of 1 mg at the left of 16, so 16 a milli-g. It feels
/// the board's tilt and the rig's vibrations, with white noise of 2 mg.
class Accelerometer {
 public:
  Accelerometer(std::uint64_t seed, std::uint32_t board_index)
      : noise_({seed, board_index, 0, rig::accelerometer}) {}

  /// The registers at t_ns, while `physics` stands at that time's grid step.
  [[nodiscard]] std::array<std::int16_t, 3> read(const rig::RigBoard& physics, std::int64_t t_ns);

 private:
  rig::RandomStream noise_;
};

}  // namespace gyrocal
