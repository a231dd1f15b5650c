#pragma once

#include <optional>

#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

enum class ChamberRun { stopped, running, paused };

/// As chamber profiles and messages call it.
[[nodiscard]] constexpr const char* name_of(ChamberRun run) {
  switch (run) {
    case ChamberRun::stopped:
      return "stopped";
    case ChamberRun::running:
      return "running";
    case ChamberRun::paused:
      return "paused";
  }
  return "stopped";
}

/// One reading of a chamber. What a profile has no register for is absent.
struct ChamberReading {
  Celsius actual;    ///< process value
  Celsius setpoint;  ///< the value the chamber says it controls to
  std::optional<ChamberRun> run;
  std::optional<bool> constant_mode;  ///< false: a program runs; hands off
  bool operator==(const ChamberReading&) const = default;
};

/// A temperature chamber. Every command is judged by reading it back; a command that returns
/// without error is in force.
class Chamber {
 public:
  virtual ~Chamber() = default;
  /// @return timeout, link_lost, refused (Modbus exception), bad_frame, not_finite.
  [[nodiscard]] virtual Result<ChamberReading> read() = 0;
  /// Refuses (out_of_range, not_finite) what lies outside the profile's limits; nothing is sent.
  /// mismatch if another value stands there after three tries: another master.
  [[nodiscard]] virtual Result<void> set_setpoint(Celsius to) = 0;
  [[nodiscard]] virtual Result<void> run() = 0;  ///< constant-temperature mode, running
  [[nodiscard]] virtual Result<void> stop() = 0;
};

}  // namespace gyrocal
