#include "compensation/firmware/ardupilot.h"

#include <fmt/format.h>

#include <algorithm>

#include "compensation/firmware/text_scan.h"
#include "compensation/values/units.h"

namespace gyrocal {
namespace {

constexpr double scale_factor = 1.0e6;

char capital(std::string_view axis) { return axis == "x" ? 'X' : axis == "y" ? 'Y' : 'Z'; }

std::string offset_name(int imu, std::string_view axis) {
  // The first IMU's name carries no number.
  return imu == 1 ? fmt::format("INS_GYROFFS_{}", capital(axis))
                  : fmt::format("INS_GYR{}OFFS_{}", imu, capital(axis));
}

std::string line(const std::string& name, double value) {
  return fmt::format("{},{:.9g}\n", name, static_cast<float>(value));
}

float correction(const ArdupilotGyro& gyro, float temperature_c) {
  constexpr auto inverse_scale = static_cast<float>(1 / scale_factor);
  const float delta =
      std::clamp(temperature_c, gyro.tmin, gyro.tmax) - static_cast<float>(ardupilot_reference_c);
  return (gyro.g[0] + (gyro.g[1] + gyro.g[2] * delta) * delta) * delta * inverse_scale;
}

}  // namespace

float offset_rad_s(const ArdupilotGyro& gyro, float temperature_c) {
  return gyro.offset + correction(gyro, temperature_c) - correction(gyro, gyro.caltemp);
}

std::string ardupilot_text(std::span<const AxisCubic> axes, int imu, std::string_view comment) {
  std::string text;
  for (const auto row : lines_of(comment)) text += fmt::format("# {}\n", row);
  const auto name = [&](std::string_view part) { return fmt::format("INS_TCAL{}_{}", imu, part); };
  const Cubic& shared = axes.front().cubic;
  const double caltemp = std::clamp(ardupilot_reference_c, shared.min_c, shared.max_c);
  text += line(name("ENABLE"), 1);
  text += line(name("TMIN"), shared.min_c);
  text += line(name("TMAX"), shared.max_c);
  text += line(fmt::format("INS_GYR{}_CALTEMP", imu), caltemp);
  for (const auto& [identity, cubic] : axes) {
    for (int order = 1; order <= 3; ++order) {
      text += line(name(fmt::format("GYR{}_{}", order, capital(identity.axis))),
                   cubic.dps[static_cast<std::size_t>(order)] * rad_per_deg * scale_factor);
    }
    text += line(offset_name(imu, identity.axis), value_at(cubic, caltemp) * rad_per_deg);
  }
  return text;
}

Result<ArdupilotGyro> read_ardupilot_text(std::string_view text, int imu, std::string_view axis) {
  std::string missing_name;
  const auto read = [&](const std::string& name) {
    const auto value = float_beside(text, name, ',', 2, 0);
    if (!value) missing_name = name;
    return value.value_or(0.0F);
  };
  ArdupilotGyro gyro;
  gyro.tmin = read(fmt::format("INS_TCAL{}_TMIN", imu));
  gyro.tmax = read(fmt::format("INS_TCAL{}_TMAX", imu));
  gyro.caltemp = read(fmt::format("INS_GYR{}_CALTEMP", imu));
  gyro.offset = read(offset_name(imu, axis));
  for (int order = 1; order <= 3; ++order) {
    gyro.g[static_cast<std::size_t>(order - 1)] =
        read(fmt::format("INS_TCAL{}_GYR{}_{}", imu, order, capital(axis)));
  }
  if (missing_name.empty()) return gyro;
  return fail(Errc::bad_input, fmt::format("ArduPilot parameters: no readable {}", missing_name));
}

}  // namespace gyrocal
