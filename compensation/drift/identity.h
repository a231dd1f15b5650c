#pragma once

#include <string>

#include "compensation/values/error.h"

namespace gyrocal {

/// Which sensor a model is of, and which thermometer its temperatures were read from: a model of
/// chamber air does not fit a board sensor that is warmer. Empty: not stated.
struct SensorIdentity {
  std::string board;              ///< MCU id or another name that is the board's own
  std::string axis;               ///< "x", "y" or "z"
  std::string temperature_scale;  ///< "board", "chamber", "setpoint", ...
  bool operator==(const SensorIdentity&) const = default;
};

/// Every part that is asked for must be stated by the model and equal.
/// @return mismatch, naming both.
[[nodiscard]] Result<void> check_identity(const SensorIdentity& model, const SensorIdentity& asked);

}  // namespace gyrocal
