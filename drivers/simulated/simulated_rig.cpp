#include "drivers/simulated/simulated_rig.h"

#include <algorithm>

#include "compensation/values/assert.h"

namespace gyrocal {

McuId simulated_mcu_id(std::size_t index) {
  return {0x30,
          0xFF,
          0xD8,
          0x05,
          0x47,
          0x52,
          0x32,
          0x37,
          0x51,
          0x16,
          static_cast<std::uint8_t>(index >> 8),
          static_cast<std::uint8_t>(index & 0xFF)};
}

SimulatedRig::SimulatedRig(const rig::RigModel& model, std::uint64_t seed, std::size_t board_count,
                           const ChamberProfile& profile, int unit, std::size_t output_bytes_max)
    : air_(model.baseline.chamber), chamber_(profile, unit, air_) {
  const auto reach_first = [this](Instant now) { reach(now); };
  chamber_.before_each(reach_first);
  for (std::size_t index = 0; index < board_count; ++index) {
    boards_.push_back(std::make_unique<SimulatedBoard>(
        rig::RigBoard(model, seed, static_cast<std::uint32_t>(index)),
        Accelerometer(seed, static_cast<std::uint32_t>(index)),
        BoardWire(seed, static_cast<std::uint32_t>(index)), air_, simulated_mcu_id(index),
        output_bytes_max));
    boards_.back()->before_each(reach_first);
  }
}

void SimulatedRig::set_faults(std::vector<RigFault> faults) {
  GYROCAL_ASSERT(turns_done_ == 0);
  turns_.clear();
  for (const RigFault& fault : faults) {
    GYROCAL_ASSERT(!fault.board || *fault.board < boards_.size());
    turns_.push_back({Instant{seconds(fault.at_s)}, true, fault});
    if (fault.for_s > 0) {
      turns_.push_back({Instant{seconds(fault.at_s + fault.for_s)}, false, fault});
    }
  }
  std::stable_sort(turns_.begin(), turns_.end(),
                   [](const Turn& a, const Turn& b) { return a.at < b.at; });
}

std::optional<Instant> SimulatedRig::next_fault() const {
  if (turns_done_ == turns_.size()) return {};
  return turns_[turns_done_].at;
}

void SimulatedRig::reach(Instant now) {
  if (reaching_) return;  // a device that is made to do something asks back
  reaching_ = true;
  while (turns_done_ < turns_.size() && turns_[turns_done_].at <= now) {
    happen(turns_[turns_done_++]);
  }
  reaching_ = false;
}

void SimulatedRig::happen(const Turn& turn) {
  if (turn.fault.board) {
    SimulatedBoard& board = *boards_.at(*turn.fault.board);
    turn.begins ? board.begin(turn.fault, turn.at) : board.end(turn.fault, turn.at);
  } else {
    turn.begins ? chamber_.begin(turn.fault, turn.at) : chamber_.end(turn.fault);
  }
}

}  // namespace gyrocal
