#pragma once

#include <chrono>
#include <cstdint>

namespace gyrocal {

/// Campaign time. On a scaled clock one second of it takes less than a second of ours.
using Instant = std::chrono::time_point<std::chrono::steady_clock, std::chrono::nanoseconds>;
using Duration = std::chrono::nanoseconds;

[[nodiscard]] constexpr Duration seconds(double s) {
  return Duration{static_cast<std::int64_t>(s * 1e9)};
}
[[nodiscard]] constexpr double to_seconds(Duration d) {
  return static_cast<double>(d.count()) * 1e-9;
}

/// All code asks an injected clock; nobody else reads the time or sleeps.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Never runs backwards, whatever happens to UTC.
  [[nodiscard]] virtual Instant now() const = 0;
  virtual void sleep_until(Instant when) = 0;
  /// Nanoseconds since 1970 in UTC, for the record only: no duration is taken from it.
  [[nodiscard]] virtual std::int64_t utc_ns() const = 0;
};

}  // namespace gyrocal
