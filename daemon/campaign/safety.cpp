#include "daemon/campaign/safety.h"

#include <cmath>

namespace gyrocal::campaign {
namespace {

constexpr Kelvin jump_max{20};
constexpr Kelvin zero_is_near{2};  ///< an exact 0.0 this close to the last reading is believed
constexpr int believed_after = 5;

bool plausible_after(Celsius last, Celsius reading) {
  const double jump = std::abs((reading - last).value);
  if (reading.value == 0.0 && jump > zero_is_near.value) return false;
  return jump <= jump_max.value;
}

}  // namespace

std::optional<Celsius> ReadingFilter::pass(Celsius reading) {
  const bool good = std::isfinite(reading.value) &&
                    (last_ ? plausible_after(*last_, reading) : reading.value != 0.0);
  if (!good) {
    ++doubtful_;
    if (!std::isfinite(reading.value) || ++in_a_row_ < believed_after) return std::nullopt;
  }
  in_a_row_ = 0;
  last_ = reading;
  return reading;
}

}  // namespace gyrocal::campaign
