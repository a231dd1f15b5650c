#pragma once

#include <deque>
#include <optional>

#include "compensation/values/units.h"
#include "config/campaign.h"
#include "drivers/clock.h"

namespace gyrocal::campaign {

/// unknown: too little or too old data to say. Never taken for stable.
enum class Verdict { unknown, unstable, stable };

/// Stage A: the air. Stable when every reading of the window lies within the band about the
/// setpoint and they differ by no more than the peak-to-peak limit.
/// Leaving the band starts the timer again; readings that did not come do not, but while they are
/// missing (longer than `unknown_after`) the verdict is unknown.
/// Source: GJB 150.1 and the settling rules of chamber controllers, facts/chamber_modbus.md 3.
class AirStability {
 public:
  AirStability(const StabilityConfig& limits, Duration unknown_after)
      : limits_(limits), unknown_after_(unknown_after) {}

  /// Another setpoint: everything before it is forgotten.
  void start(Celsius setpoint);
  /// Readings come in order of time.
  void observe(Duration t, Celsius air);
  [[nodiscard]] Verdict verdict(Duration t) const;
  /// How long the air has been within the band, up to the latest reading; 0 outside it.
  [[nodiscard]] Duration in_band() const;
  /// Of the readings in the window; 0 without any.
  [[nodiscard]] Kelvin peak_to_peak() const;

 private:
  struct Reading {
    Duration t;
    Celsius air;
  };
  StabilityConfig limits_;
  Duration unknown_after_;
  Celsius setpoint_{0};
  std::optional<Duration> band_since_;
  std::deque<Reading> window_;  ///< of the last air_window_s, within the band
};

/// The step of the board's temperature sensor (STLM75: 9 bits over 256 K).
inline constexpr Kelvin board_sensor_step{0.5};

/// Whether a sensor of this step can show a slope as small as asked. Readings that all fell into
/// one step over a window bound the slope by step/window and no better; if the limit asked for is
/// below that, silence of the sensor proves nothing and the soak has to be timed.
[[nodiscard]] bool can_resolve_slope(Kelvin step, double slope_k_per_h, double window_s);

/// Stage B: a board. Least-squares slope of its own sensor over the window.
class BoardStability {
 public:
  BoardStability(const StabilityConfig& limits, Duration unknown_after)
      : limits_(limits), unknown_after_(unknown_after) {}

  void start();
  void observe(Duration t, Celsius board);
  [[nodiscard]] Verdict verdict(Duration t) const;
  /// Of the readings in the window [K/h]; nothing until the window is full.
  [[nodiscard]] std::optional<double> slope_k_per_h() const;

 private:
  struct Reading {
    Duration t;
    Celsius board;
  };
  StabilityConfig limits_;
  Duration unknown_after_;
  std::optional<Duration> since_;
  std::deque<Reading> window_;
};

}  // namespace gyrocal::campaign
