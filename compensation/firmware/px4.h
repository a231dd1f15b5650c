#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compensation/drift/identity.h"
#include "compensation/firmware/cubic.h"

namespace gyrocal {

/// One axis of an export that carries cubics.
struct AxisCubic {
  SensorIdentity identity;
  Cubic cubic;
};

/// PX4's TC_G{n}_* of one axis, in PX4's own precision and units: offset [rad/s] =
/// x[3] dT^3 + x[2] dT^2 + x[1] dT + x[0], dT = T - tref with T clipped to tmin ... tmax, and the
/// offset is subtracted from the measured rate.
/// Source: PX4-Autopilot src/modules/temperature_compensation/TemperatureCompensation.{h,cpp}
/// (calc_thermal_offsets_3D); default TC_G0_TREF 25 (temp_comp_params_gyro.c). Read at commits
/// 25ed6b6 and 09f282b.
struct Px4Gyro {
  float tref = 0, tmin = 0, tmax = 0;
  std::array<float, 4> x{};
};
[[nodiscard]] float offset_rad_s(const Px4Gyro& gyro, float temperature_c);

inline constexpr double px4_reference_c = 25;

/// A QGroundControl parameter file (vehicle, component, name, value, MAV_PARAM_TYPE; 6 = int32,
/// 9 = float), as PX4's Tools/process_sensor_caldata.py writes it. Axes that were not calibrated
/// are not mentioned, so they keep what they have.
/// @param instance   0 ... 3: the n of TC_G{n}
/// @param device_id  TC_G{n}_ID, by which PX4 finds the sensor; left out when unknown.
[[nodiscard]] std::string px4_text(std::span<const AxisCubic> axes, int instance,
                                   std::optional<std::uint32_t> device_id,
                                   std::string_view comment);
/// @return bad_input when a parameter of that axis is missing.
[[nodiscard]] Result<Px4Gyro> read_px4_text(std::string_view text, int instance,
                                            std::string_view axis);

}  // namespace gyrocal
