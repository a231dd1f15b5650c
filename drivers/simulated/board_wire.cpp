#include "drivers/simulated/board_wire.h"

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

constexpr std::size_t garbage_bytes_max = 20;

}  // namespace

void BoardWire::set(RigFaultKind kind, double share) {
  GYROCAL_ASSERT(kind == RigFaultKind::garbage || kind == RigFaultKind::duplicate ||
                 kind == RigFaultKind::drop);
  double& changed = kind == RigFaultKind::garbage     ? garbage_share_
                    : kind == RigFaultKind::duplicate ? duplicate_share_
                                                      : drop_share_;
  changed = share;
}

std::size_t BoardWire::below(std::size_t count) {
  return static_cast<std::size_t>(random_.uniform() * static_cast<double>(count));
}

void BoardWire::spoil(Bytes& output, std::size_t frame_begin) {
  const auto begin = static_cast<std::ptrdiff_t>(frame_begin);
  if (happens(duplicate_share_)) {
    const Bytes frame(output.begin() + begin, output.end());
    output.insert(output.end(), frame.begin(), frame.end());
  }
  if (!happens(garbage_share_)) return;
  if (happens(0.5)) {
    output.resize(output.size() - 1 - below(output.size() - frame_begin));
    return;
  }
  Bytes noise(1 + below(garbage_bytes_max));
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random_.bits() & 0xFF);
  output.insert(output.begin() + begin, noise.begin(), noise.end());
}

}  // namespace gyrocal
