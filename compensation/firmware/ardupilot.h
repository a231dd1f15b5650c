#pragma once

#include "compensation/firmware/px4.h"

namespace gyrocal {

/// ArduPilot's INS_TCAL{n}_* of one axis in its own precision and units: correction [rad/s] =
/// 1e-6 (g[0] dT + g[1] dT^2 + g[2] dT^3), dT = T - 35 degC, T clipped to tmin ... tmax; there is
/// no constant term. The constant is the gyro offset [rad/s] found at caltemp, so the whole is
/// offset + correction(T) - correction(caltemp), subtracted from the measured rate. ArduPilot
/// learns the offset anew at each start unless INS_GYR_CAL is 0.
/// Source: ardupilot libraries/AP_InertialSensor/AP_InertialSensor_tempcal.cpp (SCALE_FACTOR 1.0e6,
/// TEMP_REFERENCE 35.0, polynomial_eval, correct_sensor; read at commit 025810d) and
/// AP_InertialSensor.cpp (GYROFFS in rad/s, GYR1_CALTEMP in degC).
struct ArdupilotGyro {
  float tmin = 0, tmax = 0;
  std::array<float, 3> g{};
  float offset = 0, caltemp = 0;
};
[[nodiscard]] float offset_rad_s(const ArdupilotGyro& gyro, float temperature_c);

inline constexpr double ardupilot_reference_c = 35;

/// A parameter file NAME,value for Mission Planner and MAVProxy.
/// @param imu  1 ... 3: the n of INS_TCAL{n}
[[nodiscard]] std::string ardupilot_text(std::span<const AxisCubic> axes, int imu,
                                         std::string_view comment);
/// @return bad_input when a parameter of that axis is missing.
[[nodiscard]] Result<ArdupilotGyro> read_ardupilot_text(std::string_view text, int imu,
                                                        std::string_view axis);

}  // namespace gyrocal
