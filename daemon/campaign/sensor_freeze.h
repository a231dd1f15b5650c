#pragma once

#include <optional>

#include "compensation/values/units.h"

namespace gyrocal::campaign {

/// Notices a board's temperature register that has stopped: an STLM75 read faster than it converts
/// no longer updates (facts: data sheet Doc 13296, p. 18). The air has moved well beyond the
/// board's lag, and the board has not moved by one step.
class SensorFreeze {
 public:
  void air(Celsius reading);
  void board(Celsius reading);
  [[nodiscard]] bool frozen() const;

 private:
  std::optional<Celsius> board_;
  std::optional<Celsius> air_;      ///< as last read
  std::optional<Celsius> air_low_;  ///< range of the air since the board's reading last changed
  std::optional<Celsius> air_high_;
};

}  // namespace gyrocal::campaign
