#pragma once

#include <cstdint>
#include <memory>

#include "compensation/rig/rig_model.h"
#include "daemon/runner/preflight.h"
#include "drivers/recording/recording_layers.h"

namespace gyrocal::runner {

/// Clock, links and drivers of a campaign, kept together for as long as it runs.
class OwnedDevices {
 public:
  virtual ~OwnedDevices() = default;
  [[nodiscard]] virtual Devices devices() = 0;
  [[nodiscard]] virtual Recorder* recorder() = 0;  ///< of the links, if they are recorded
};

/// The links a campaign file names: Modbus TCP or RTU, serial ports, the machine's clock at the
/// file's time scale. Nothing is opened yet.
/// @param writer  records what passes the links; outlives the devices.
[[nodiscard]] std::unique_ptr<OwnedDevices> wired_devices(const CampaignConfig& config,
                                                          RecordingWriter* writer = nullptr);

/// The simulated rig in this process, on a virtual clock: the same drivers over links without
/// wires. The same seed gives the same campaign to the last bit.
[[nodiscard]] std::unique_ptr<OwnedDevices> virtual_devices(const CampaignConfig& config,
                                                            const rig::RigModel& model,
                                                            std::uint64_t seed,
                                                            RecordingWriter* writer = nullptr);

}  // namespace gyrocal::runner
