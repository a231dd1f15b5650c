#include "drivers/simulated/simulated_rig.h"

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
  for (std::size_t index = 0; index < board_count; ++index) {
    boards_.push_back(std::make_unique<SimulatedBoard>(
        rig::RigBoard(model, seed, static_cast<std::uint32_t>(index)),
        Accelerometer(seed, static_cast<std::uint32_t>(index)), air_, simulated_mcu_id(index),
        output_bytes_max));
  }
}

}  // namespace gyrocal
