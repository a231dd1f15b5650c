#pragma once

#include <optional>

#include "compensation/values/units.h"
#include "drivers/clock.h"

namespace gyrocal::campaign {

/// A ramp made by writing interpolated setpoints: the map of a Yinhe has no ramp-rate register. It
/// starts from the air's temperature, not from the last setpoint, so that a chamber that was away
/// is met where it is. At most one write a minute, and the last one is the target itself: setpoints
/// may rest in an EEPROM (facts/chamber_modbus.md 1a, 3d).
class SetpointRamp {
 public:
  SetpointRamp(Duration start, Celsius from, Celsius target, Kelvin per_minute)
      : start_(start), from_(from), target_(target), per_minute_(per_minute) {}

  /// The setpoint to write now, if one is due: the place the ramp reaches within the next minute.
  [[nodiscard]] std::optional<Celsius> due(Duration t) const;
  /// The caller has written what was due at t.
  void written(Duration t, Celsius setpoint);
  [[nodiscard]] bool finished() const { return last_ == target_; }
  [[nodiscard]] Celsius target() const { return target_; }

 private:
  Duration start_;
  Celsius from_;
  Celsius target_;
  Kelvin per_minute_;
  std::optional<Duration> written_at_;
  std::optional<Celsius> last_;
};

}  // namespace gyrocal::campaign
