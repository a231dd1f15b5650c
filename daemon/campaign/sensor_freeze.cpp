#include "daemon/campaign/sensor_freeze.h"

#include <algorithm>
#include <cmath>

namespace gyrocal::campaign {
namespace {

/// More than a ramp of 2 K/min gains on a board that lags by four minutes.
constexpr Kelvin air_moved{12};
constexpr Kelvin half_a_step{0.25};

}  // namespace

void SensorFreeze::air(Celsius reading) {
  air_low_ = air_low_ ? std::min(*air_low_, reading) : reading;
  air_high_ = air_high_ ? std::max(*air_high_, reading) : reading;
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
