#pragma once

namespace gyrocal::rig {

/// One first-order lag: dy/dt = (u - y)/tau. `advance` is exact for an input that is straight
/// between the two instants, whatever the step.
class ThermalLag {
 public:
  /// tau_s > 0; starts in equilibrium at `start`.
  ThermalLag(double tau_s, double start) : tau_s_(tau_s), value_(start), input_(start) {}
  /// Input reaches `input` after dt_s, on a straight line. Returns the output there.
  double advance(double dt_s, double input);
  [[nodiscard]] double value() const { return value_; }

 private:
  double tau_s_;
  double value_;
  double input_;
  double step_s_ = -1.0;  // the step the two factors below belong to
  double decay_ = 1.0;
  double mean_decay_ = 1.0;
};

/// Air -> board -> die, two lags in a row, exact for air that is straight between two instants.
class BoardThermals {
 public:
  BoardThermals(double tau_board_s, double tau_die_s, double start_c);
  void advance(double dt_s, double air_c);
  [[nodiscard]] double board_c() const { return board_c_; }
  [[nodiscard]] double die_c() const { return die_c_; }
  /// d(die)/dt [degC/min], exact: (board - die)/tau_die.
  [[nodiscard]] double die_rate_c_per_min() const {
    return (board_c_ - die_c_) / tau_die_s_ * 60.0;
  }

 private:
  void prepare(double dt_s);
  double tau_board_s_;
  double tau_die_s_;
  double board_c_;
  double die_c_;
  double air_c_;
  double step_s_ = -1.0;
  double board_decay_ = 1.0;
  double die_decay_ = 1.0;
  double passed_on_ = 0.0;  // of the board's transient that reaches the die within the step
};

}  // namespace gyrocal::rig
