#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/board/frame.h"
#include "drivers/link.h"

namespace gyrocal {

/// The firmware's sensor parameters (commands 20, 21, 22). They live in RAM and act on calibrated
/// frames only: the gain is software, so raw counts never see them.
struct SensorParameters {
  std::uint8_t roll_pitch_full_scale = 4;  ///< 4: 300 deg/s; 8: 1200 deg/s
  std::int16_t roll_offset = 0;            ///< counts
  std::int16_t pitch_offset = 0;
  std::uint8_t yaw_full_scale = 4;  ///< 300 deg/s, the only one
  std::int16_t yaw_offset = 0;
  std::uint8_t pressure_rate = 1;  ///< output rate code, 1 or 3
  std::int16_t pressure_offset = 0;
  std::int16_t temperature_offset = 0;
  bool operator==(const SensorParameters&) const = default;
};

/// @param payload  sensor, parameter, value (one byte, or two MSB first for an offset).
/// @return nothing when done; wrong_syntax for a length that does not fit, out_of_range for a
///   sensor, parameter or value the firmware has not.
[[nodiscard]] std::optional<inemo::Nack> set_parameter(SensorParameters& parameters,
                                                       std::span<const std::uint8_t> payload);
/// @param payload  sensor, parameter.
/// @return sensor, parameter, value.
[[nodiscard]] tl::expected<Bytes, inemo::Nack> get_parameter(const SensorParameters& parameters,
                                                             std::span<const std::uint8_t> payload);
/// Puts the default back. A gyro's full scale never is: firmware 2.2 checks a wrong length there
/// and refuses with not_executable.
[[nodiscard]] std::optional<inemo::Nack> restore_parameter(SensorParameters& parameters,
                                                           std::span<const std::uint8_t> payload);

}  // namespace gyrocal
