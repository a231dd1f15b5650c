#pragma once

#include <cstddef>
#include <cstdint>

#include "compensation/rig/random.h"
#include "config/rig_faults.h"
#include "drivers/link.h"

namespace gyrocal {

/// What a bad wire does to a board's frames. Draws nothing while all is well, so a fault list
/// changes the bytes only while its faults last.
class BoardWire {
 public:
  BoardWire(std::uint64_t seed, std::uint32_t board_index)
      : random_({seed, board_index, 0, rig::wire_faults}) {}

  /// @param kind  garbage, duplicate or drop.  @param share  of frames; 0: sound again.
  void set(RigFaultKind kind, double share);

  /// Whether the next frame is lost as a whole.
  [[nodiscard]] bool loses_frame() { return happens(drop_share_); }
  /// Does what it does to the frame at the end of `output`.
  void spoil(Bytes& output, std::size_t frame_begin);

 private:
  [[nodiscard]] bool happens(double share) { return share > 0 && random_.uniform() < share; }
  [[nodiscard]] std::size_t below(std::size_t count);

  rig::RandomStream random_;
  double garbage_share_ = 0;
  double duplicate_share_ = 0;
  double drop_share_ = 0;
};

}  // namespace gyrocal
