#pragma once

#include <cstdint>
#include <memory>

#include "compensation/rig/rig_model.h"
#include "daemon/runner/preflight.h"

namespace gyrocal::runner {

/// Clock, links and drivers of a campaign, kept together for as long as it runs.
class OwnedDevices {
 public:
  virtual ~OwnedDevices() = default;
  [[nodiscard]] virtual Devices devices() = 0;
};

/// The links a campaign file names: Modbus TCP or RTU, serial ports, the machine's clock at the
/// file's time scale. Nothing is opened yet.
[[nodiscard]] std::unique_ptr<OwnedDevices> wired_devices(const CampaignConfig& config);

/// The simulated rig in this process, on a virtual clock: the same drivers over links without
/// wires. The same seed gives the same campaign to the last bit.
[[nodiscard]] std::unique_ptr<OwnedDevices> virtual_devices(const CampaignConfig& config,
                                                            const rig::RigModel& model,
                                                            std::uint64_t seed);

}  // namespace gyrocal::runner
