#pragma once

#include <string>

#include "drivers/clock.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/drivers/simulated/hex.h"
#include "tests/drivers/simulated/profiles.h"

namespace gyrocal {

inline Instant at_s(double s) { return Instant{seconds(s)}; }

/// One board of a rig, spoken to in hex at given times.
class BenchBoard {
 public:
  explicit BenchBoard(const rig::RigModel& model = {}, std::size_t output_bytes_max = SIZE_MAX)
      : rig(model, 1, 1, yinhe_profile(), 1, output_bytes_max), board(rig.board(0)) {}

  /// Sends one packet and takes all that is there.
  std::string say(const std::string& packet, double t_s = 0) {
    board.receive(bytes(packet), at_s(t_s));
    return taken();
  }
  /// All that has come by t_s.
  std::string heard(double t_s) {
    board.advance(at_s(t_s));
    return taken();
  }
  std::string taken() {
    const std::string text = hex(board.output());
    board.take(board.output().size());
    return text;
  }

  SimulatedRig rig;
  SimulatedBoard& board;
};

/// A rig whose numbers are exact: no noise, no drift but a constant per axis, in counts.
inline rig::RigModel still_model(std::array<int, 3> counts) {
  rig::RigModel model;
  model.baseline.noise_dps = 0;
  model.baseline.lsb_per_dps = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    model.baseline.bias[axis] = rig::CubicBias{{static_cast<double>(counts[axis]), 0, 0, 0}};
  }
  return model;
}

}  // namespace gyrocal
