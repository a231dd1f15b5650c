#include "drivers/clocks.h"

#include <cmath>
#include <thread>

namespace gyrocal {

ScaledClock::ScaledClock(double scale) : scale_(scale), origin_(std::chrono::steady_clock::now()) {}

Instant ScaledClock::now() const {
  const auto wall = std::chrono::steady_clock::now() - origin_;
  const auto scaled = static_cast<double>(wall.count()) * scale_;
  return Instant{Duration{std::llround(scaled)}};
}

void ScaledClock::sleep_until(Instant when) {
  const double wall_ns = static_cast<double>(when.time_since_epoch().count()) / scale_;
  std::this_thread::sleep_until(origin_ + Duration{std::llround(wall_ns)});
}

std::int64_t ScaledClock::utc_ns() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace gyrocal
