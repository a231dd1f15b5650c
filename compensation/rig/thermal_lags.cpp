#include "compensation/rig/thermal_lags.h"

#include <cmath>

#include "compensation/rig/portable_math.h"
#include "compensation/values/assert.h"

namespace gyrocal::rig {

double ThermalLag::advance(double dt_s, double input) {
  GYROCAL_ASSERT(dt_s >= 0.0 && tau_s_ > 0.0);
  if (dt_s == 0.0) {
    input_ = input;
    return value_;
  }
  if (dt_s != step_s_) {
    step_s_ = dt_s;
    decay_ = portable_exp(-dt_s / tau_s_);
    const double x = dt_s / tau_s_;
    // (1 - e^-x)/x, by its series where the difference would cancel
    mean_decay_ = x < 1e-3 ? 1.0 - x / 2.0 + x * x / 6.0 : (1.0 - decay_) / x;
  }
  value_ = value_ * decay_ + input_ * (mean_decay_ - decay_) + input * (1.0 - mean_decay_);
  input_ = input;
  return value_;
}

BoardThermals::BoardThermals(double tau_board_s, double tau_die_s, double start_c)
    : tau_board_s_(tau_board_s),
      tau_die_s_(tau_die_s),
      board_c_(start_c),
      die_c_(start_c),
      air_c_(start_c) {
  GYROCAL_ASSERT(tau_board_s > 0.0 && tau_die_s > 0.0);
}

void BoardThermals::prepare(double dt_s) {
  step_s_ = dt_s;
  board_decay_ = portable_exp(-dt_s / tau_board_s_);
  die_decay_ = portable_exp(-dt_s / tau_die_s_);
  const double difference = tau_board_s_ - tau_die_s_;
  const bool equal = std::abs(difference) < 1e-6 * tau_board_s_;
  passed_on_ = equal ? dt_s / tau_die_s_ * die_decay_
                     : (board_decay_ - die_decay_) * tau_board_s_ / difference;
}

void BoardThermals::advance(double dt_s, double air_c) {
  GYROCAL_ASSERT(dt_s >= 0.0);
  if (dt_s == 0.0) {
    air_c_ = air_c;
    return;
  }
  if (dt_s != step_s_) prepare(dt_s);
  const double slope = (air_c - air_c_) / dt_s;
  // On a ramp the board trails the air by slope*tau_board, the die by slope*(tau_board+tau_die);
  // what differs from that at the start decays.
  const double board_behind = slope * tau_board_s_;
  const double die_behind = slope * (tau_board_s_ + tau_die_s_);
  const double board_transient = board_c_ - (air_c_ - board_behind);
  const double die_transient = die_c_ - (air_c_ - die_behind);
  board_c_ = air_c - board_behind + board_transient * board_decay_;
  die_c_ = air_c - die_behind + die_transient * die_decay_ + board_transient * passed_on_;
  air_c_ = air_c;
}

}  // namespace gyrocal::rig
