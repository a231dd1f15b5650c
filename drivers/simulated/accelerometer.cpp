#include "drivers/simulated/accelerometer.h"

#include <algorithm>
#include <cmath>

#include "compensation/rig/portable_math.h"

namespace gyrocal {
namespace {

constexpr double noise_g = 2e-3;
constexpr double mg_max = 2047;

std::int16_t raw_register(double along_g) {
  const double mg = std::clamp(std::floor(along_g * 1000.0 + 0.5), -mg_max, mg_max);
  return static_cast<std::int16_t>(mg * 16.0);
}

}  // namespace

std::array<std::int16_t, 3> Accelerometer::read(const rig::RigBoard& physics, std::int64_t t_ns) {
  std::array<double, 3> force_g = physics.specific_force_g();
  for (double& along : force_g) along += noise_g * noise_.normal();
  for (const rig::Line& line : physics.lines()) {
    force_g[2] += line.acc_g * rig::portable_sine(line.f_hz * static_cast<double>(t_ns) * 1e-9);
  }
  return {raw_register(force_g[0]), raw_register(force_g[1]), raw_register(force_g[2])};
}

}  // namespace gyrocal
