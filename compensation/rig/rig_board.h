#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compensation/rig/active_effects.h"
#include "compensation/rig/chamber_air.h"
#include "compensation/rig/random.h"
#include "compensation/rig/rig_model.h"
#include "compensation/rig/thermal_lags.h"

namespace gyrocal::rig {

/// One frame's content as the board's firmware would send it in raw mode.
struct RigSample {
  std::int64_t t_ns = 0;                   ///< campaign time at which the board took it
  std::array<std::int16_t, 3> gyro_lsb{};  ///< X Y Z, clipped to the ADC's range
  std::int16_t temperature_raw = 0;        ///< STLM75: degC * 256 in steps of 0x80
  bool lost = false;                       ///< counted by the board but lost on the way
  bool operator==(const RigSample&) const = default;
};

/// One simulated board in a chamber: temperatures, bias, the model's effects, noise, ADC. Pure,
/// seeded, causal: it asks the air only at instants that are already asked for, and the same
/// samples come out however the time is cut into calls.
///
///   ChamberAir air(model.baseline.chamber);
///   RigBoard board(model, seed, 0);        // board 0 of any number; powered on at t = 0
///   air.run(0.0, Celsius{-10.0});
///   board.start(5'000'000'000, 50.0);      // the Start command arrives at 5 s, 50 Hz
///   std::vector<RigSample> samples;
///   board.take_until(air, 6'000'000'000, samples);  // appends 51: t = 5.00 ... 6.00 s
///   air.run(6.0, Celsius{20.0});           // commands must be given to the air before the board
///   board.take(air, 100, samples);         // ... is asked for anything later: the next 100
///   board.temperature_raw(air, 8'500'000'000);  // while not streaming, too
///
/// Temperatures and drift move on a grid of 0.2 s of campaign time and are held in between: at
/// 1 degC/min that is 0.003 degC, at the paper's slope 0.03 mdps.
/// Cost: about 40 ns a sample of three axes without effects, the physics grid included.
class RigBoard {
 public:
  /// Effects must have been checked (instantiate(model) in effects/effect.h; a model read by
  /// config/rig_model.h is).
  RigBoard(const RigModel& model, std::uint64_t seed, std::uint32_t board_index);

  /// A power cycle at t_ns: time since power-on starts anew; temperatures and mechanics go on.
  void power_on(std::int64_t t_ns) { power_on_ns_ = t_ns; }

  /// The first sample is taken at t_ns, then one every 1/rate_hz. Times never go backwards.
  void start(std::int64_t t_ns, double rate_hz);

  /// Appends the next `count` samples. The board must have been started.
  void take(const ChamberAir& air, std::int64_t count, std::vector<RigSample>& out);
  /// Appends every sample not yet taken with time <= t_ns; none before the first start.
  void take_until(const ChamberAir& air, std::int64_t t_ns, std::vector<RigSample>& out);
  /// Time of the next sample. The board must have been started.
  [[nodiscard]] std::int64_t next_sample_ns() const;

  /// Lets temperatures run on to t_ns without taking samples (a board that does not stream).
  void advance(const ChamberAir& air, std::int64_t t_ns);
  /// The sensor's register at t_ns (not before the last sample taken).
  [[nodiscard]] std::int16_t temperature_raw(const ChamberAir& air, std::int64_t t_ns);
  /// The accelerometer's true input, tilts included, as of the last advance [g].
  [[nodiscard]] std::array<double, 3> specific_force_g() const { return drivers_.acc_g; }
  /// Lines on the samples now (compressor, mains), also for the accelerometer.
  [[nodiscard]] std::vector<Line> lines() const { return board_effects_.lines(drivers_); }
  /// What no real board tells: for tests and displays, as of the last advance.
  [[nodiscard]] const Drivers& drivers() const { return drivers_; }
  [[nodiscard]] Celsius board_temperature() const { return {thermals_.board_c()}; }
  [[nodiscard]] Celsius die_temperature() const { return {thermals_.die_c()}; }

 private:
  void step_grid(const ChamberAir& air);
  void reach_grid(const ChamberAir& air, std::int64_t t_ns);
  void feel(double dt_s);
  void take_within_step(std::size_t count, std::vector<RigSample>& out);
  void take_axis(std::size_t axis, std::span<const double> t_s, std::span<RigSample> out);

  Baseline baseline_;
  BoardThermals thermals_;
  std::array<CubicBias, 3> bias_;
  std::array<RandomStream, 3> noise_;
  std::vector<AxisEffects> axis_effects_;  // three
  BoardEffects board_effects_;
  Drivers drivers_;
  std::int64_t grid_index_ = 0;  // physics stands at grid_index_ * grid step
  std::int64_t power_on_ns_ = 0;
  std::array<double, 3> drift_dps_{};
  std::int16_t temperature_raw_ = 0;
  std::int64_t start_ns_ = 0;
  std::int64_t taken_ = 0;
  double rate_hz_ = 0.0;  // 0: never started
};

}  // namespace gyrocal::rig
