#pragma once

#include "drivers/clock.h"

namespace gyrocal {

/// The machine's steady clock, run `scale` times as fast. A scale of 1 is real time; any other is
/// only for simulated devices that run equally fast (`gyrocal rig serve --time-scale`).
class ScaledClock final : public Clock {
 public:
  explicit ScaledClock(double scale = 1.0);
  [[nodiscard]] Instant now() const override;
  void sleep_until(Instant when) override;
  [[nodiscard]] std::int64_t utc_ns() const override;

 private:
  double scale_;
  std::chrono::steady_clock::time_point origin_;
};

/// Discrete events: time stands still until somebody sleeps, so a weekend takes a second and the
/// same inputs give the same times to the last bit.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(std::int64_t utc_start_ns = 0) : utc_start_ns_(utc_start_ns) {}
  [[nodiscard]] Instant now() const override { return now_; }
  void sleep_until(Instant when) override { now_ = when > now_ ? when : now_; }
  [[nodiscard]] std::int64_t utc_ns() const override {
    return utc_start_ns_ + now_.time_since_epoch().count();
  }

 private:
  std::int64_t utc_start_ns_;
  Instant now_{};
};

}  // namespace gyrocal
