#include "daemon/campaign/sensor_freeze.h"

#include <algorithm>
#include <cmath>

namespace gyrocal::campaign {
namespace {

/// More than a ramp of 2 K/min gains on a board that lags by four minutes.
constexpr Kelvin air_moved{12};
constexpr Kelvin half_a_step{0.25};
/// More than air moves from one reading to the next: the thermometer jumped, not the air.
constexpr Kelvin jump{5};

}  // namespace

void SensorFreeze::air(Celsius reading) {
  const bool jumped = air_ && std::abs((reading - *air_).value) > jump.value;
  air_ = reading;
  air_low_ = air_low_ && !jumped ? std::min(*air_low_, reading) : reading;
  air_high_ = air_high_ && !jumped ? std::max(*air_high_, reading) : reading;
}

void SensorFreeze::board(Celsius reading) {
  if (board_ && std::abs((reading - *board_).value) < half_a_step.value) return;
  board_ = reading;
  air_low_.reset();
  air_high_.reset();
}

bool SensorFreeze::frozen() const {
  return board_ && air_low_ && *air_high_ - *air_low_ >= air_moved;
}

}  // namespace gyrocal::campaign
