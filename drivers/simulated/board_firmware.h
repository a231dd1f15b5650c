#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/board/frame.h"
#include "drivers/link.h"
#include "drivers/simulated/sensor_parameters.h"

namespace gyrocal {

/// The 12 bytes of the STM32's unique id, as the chip has them; command 12 sends them backwards.
using McuId = std::array<std::uint8_t, 12>;

/// The command set of iNEMO V2 firmware 2.2 as a pure machine: one USB packet in, its reply out,
/// and what the rest of the board has to do about it. Built without AHRS and without trace: AHRS
/// output and rate code 7 are out of range, the AHRS version is unsupported, Trace gets no reply.
///
/// What the sheets leave open and is chosen here: a packet shorter than a header is refused with
/// id 0; the header is judged first, then the connection, then the id, then the length; settings
/// are forbidden while data streams (UM1744 says so of the M1); Disconnect stops no stream.
class BoardFirmware {
 public:
  explicit BoardFirmware(const McuId& mcu_id) : mcu_id_(mcu_id) {}

  enum class Deed { none, start, stop, reset, identify, leave_for_dfu };
  struct Answer {
    Bytes reply;  ///< empty: none
    Deed deed = Deed::none;
  };
  /// @param packet  one USB packet, which is one write of the host: exactly one command.
  [[nodiscard]] Answer handle(std::span<const std::uint8_t> packet, bool streaming);

  /// Power-up: not connected, all settings back to their defaults.
  void boot() { *this = BoardFirmware(mcu_id_); }

  [[nodiscard]] const inemo::OutputMode& mode() const { return mode_; }
  [[nodiscard]] const SensorParameters& parameters() const { return parameters_; }

 private:
  [[nodiscard]] Answer carry_out(inemo::Id id, std::span<const std::uint8_t> payload,
                                 bool streaming);
  [[nodiscard]] Answer tell(inemo::Id id) const;
  [[nodiscard]] Answer change(inemo::Id id, std::span<const std::uint8_t> payload);
  [[nodiscard]] Answer set_mode(std::span<const std::uint8_t> payload);

  McuId mcu_id_;
  bool connected_ = false;
  inemo::OutputMode mode_ = inemo::boot_mode;
  SensorParameters parameters_;
};

}  // namespace gyrocal
