#include "drivers/simulated/calibrated_frame.h"

namespace gyrocal {
namespace {

constexpr double lsb_per_dps_300 = 4.13;   // LPR430AL, 4x output
constexpr double lsb_per_dps_1200 = 1.03;  // LPR430AL, 1x output
constexpr double lsb_per_dps_yaw = 4.62;   // LY330ALH, as the firmware has it
constexpr int acc_lsb_per_mg = 16;         // LSM303DLH at 2 g, 12 bits at the left
constexpr double mag_lsb_per_mgauss = 1.055;
constexpr int pressure_lsb_per_mbar = 16;

std::int16_t whole_dps(std::int16_t counts, std::int16_t offset, double lsb_per_dps) {
  return static_cast<std::int16_t>((counts - offset) / lsb_per_dps);
}

}  // namespace

std::int16_t calibrated_temperature(std::int16_t raw) {
  const int half_degrees = raw / 128;
  const int sign = half_degrees < 0 ? 0x8000 : 0;
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(sign | (half_degrees & 0xFF) * 5));
}

inemo::DataFrame calibrated(const inemo::DataFrame& raw, const SensorParameters& parameters) {
  inemo::DataFrame frame = raw;
  const double roll_pitch =
      parameters.roll_pitch_full_scale == 8 ? lsb_per_dps_1200 : lsb_per_dps_300;
  frame.gyro = {whole_dps(raw.gyro[0], parameters.roll_offset, roll_pitch),
                whole_dps(raw.gyro[1], parameters.pitch_offset, roll_pitch),
                whole_dps(raw.gyro[2], parameters.yaw_offset, lsb_per_dps_yaw)};
  for (auto& axis : frame.accelerometer) axis = static_cast<std::int16_t>(axis / acc_lsb_per_mg);
  for (auto& axis : frame.magnetometer) {
    axis = static_cast<std::int16_t>(axis / mag_lsb_per_mgauss);
  }
  frame.pressure = static_cast<std::uint16_t>((raw.pressure - parameters.pressure_offset) * 10 /
                                              pressure_lsb_per_mbar);
  frame.temperature = calibrated_temperature(
      static_cast<std::int16_t>(raw.temperature - parameters.temperature_offset));
  return frame;
}

}  // namespace gyrocal
