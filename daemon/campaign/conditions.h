#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "daemon/campaign/campaign.h"
#include "daemon/campaign/stability.h"

namespace gyrocal::campaign {

/// expected: it streams. away: it is waited for. given_up: the campaign goes on without it, and
/// takes it back when it returns.
enum class Presence { expected, away, given_up };

/// How a dwell's soak ended.
struct Soak {
  Duration in_band{};
  bool timed = false;  ///< the board's sensor could not show the asked slope
};

/// What the campaign waits for, judged from readings alone: tells the state machine when a ramp has
/// arrived, a soak has settled, a dwell was disturbed, or a wait has lasted too long. Pure: times
/// come with the readings.
class Conditions {
 public:
  /// @param unknown_after  readings older than this prove nothing.
  Conditions(const Plan& plan, Duration unknown_after);

  /// The state machine went into `state`; the wait of that state begins.
  void entered(const State& state, Duration t);
  void air(Duration t, Celsius reading);
  /// What the chamber has confirmed it controls to: the way home ends at the safe setpoint itself.
  void commanded(std::optional<Celsius> setpoint) { commanded_ = setpoint; }
  void board_temperature(std::size_t board, Duration t, Celsius reading);
  void presence(std::size_t board, Presence presence);
  /// A sensor whose register has stopped (STLM75 read too fast) shows no slope: its soak is timed.
  void sensor_frozen(std::size_t board, bool frozen);

  /// What has become true of `state` by t; the first of it, if anything.
  [[nodiscard]] std::optional<Event> due(const State& state, Duration t) const;
  [[nodiscard]] Soak soak(std::size_t board) const;
  /// Of the board's temperature over its window, for who watches; nothing until that is full.
  [[nodiscard]] std::optional<double> slope_k_per_h(std::size_t board) const {
    return boards_[board].stability.slope_k_per_h();
  }
  [[nodiscard]] std::optional<Celsius> latest_air() const { return air_; }

 private:
  struct BoardState {
    BoardStability stability;
    Presence presence = Presence::expected;
    bool frozen = false;
  };

  void learn_from_ramp(Duration t);
  [[nodiscard]] bool timed(const BoardState& board) const;
  [[nodiscard]] bool boards_settled(Duration t) const;
  [[nodiscard]] std::optional<std::string> missing_board() const;
  [[nodiscard]] std::optional<Event> while_ramping(const Visit& visit, Duration t) const;
  [[nodiscard]] std::optional<Event> while_soaking(Duration t) const;
  [[nodiscard]] std::string why_air_is_unsettled() const;
  [[nodiscard]] std::optional<Event> while_logging(const Visit& visit, Duration t) const;
  [[nodiscard]] std::optional<Event> while_returning(Duration t) const;
  [[nodiscard]] Duration ramp_bound(Celsius target) const;
  [[nodiscard]] bool too_long_on_the_way(Celsius target, Duration t) const;

  Plan plan_;
  Duration unknown_after_;
  AirStability air_stability_;
  std::vector<BoardState> boards_;
  std::optional<Celsius> air_;
  std::optional<Celsius> target_;
  double slowness_ = 1;  ///< of the slowest ramp so far, against the one asked for
  std::optional<Celsius> commanded_;
  Duration since_{};                 ///< when the present state was entered
  std::optional<Celsius> air_then_;  ///< and how warm the air was
  std::optional<Celsius> heading_;   ///< where the air is on its way to
  Kelvin nearest_{0};                ///< it has come so close,
  Duration nearer_at_{};             ///< and made its last step towards it then
};

}  // namespace gyrocal::campaign
