#pragma once

#include <vector>

#include "compensation/values/units.h"

namespace gyrocal::rig {

/// How the air of a chamber moves.
struct ChamberPhysics {
  double heating_c_per_min = 1.0;  ///< steepest rise
  double cooling_c_per_min = 0.7;  ///< steepest fall, positive
  double approach_tau_s = 60.0;    ///< first-order approach to the setpoint, inside the limits
  double cycling_c = 0.15;         ///< the controller's limit cycle: half of peak to peak
  double cycling_period_s = 420.0;
  double ambient_c = 23.0;  ///< where the air drifts when the chamber is stopped
  double ambient_tau_s = 3600.0;
  bool operator==(const ChamberPhysics&) const = default;
};

/// The air temperature of a simulated chamber as a function of time, made by the commands it got.
///
/// dT/dt = (setpoint - T)/approach_tau, limited to [-cooling, heating], plus a sine of the limit
/// cycle while running; (ambient - T)/ambient_tau when stopped. Solved in closed form between
/// commands, so any instant can be asked at any time and no step size enters. All commands are
/// kept: `at` of an instant before the last command is still exact.
///
///   ChamberAir air(ChamberPhysics{});      // stopped, at ambient
///   air.run(0.0, Celsius{-10.0});          // the panel's run key with a setpoint
///   air.at(3600.0);                        // -10 +- 0.15 degC
///   air.stop(7200.0);
class ChamberAir {
 public:
  explicit ChamberAir(const ChamberPhysics& physics);

  /// Runs toward `setpoint` from `t_s` on (also: changes the setpoint while running). Times never
  /// go backwards. The limit cycle keeps its phase while the chamber stays running.
  void run(double t_s, Celsius setpoint);
  void stop(double t_s);

  [[nodiscard]] Celsius at(double t_s) const;
  /// The derivative of `at` [degC/min].
  [[nodiscard]] double rate_c_per_min(double t_s) const;
  [[nodiscard]] bool running_at(double t_s) const;
  /// The setpoint in force; ambient while stopped.
  [[nodiscard]] Celsius setpoint_at(double t_s) const;

 private:
  struct Segment {
    double t_s;
    double start_c;  // without the limit cycle
    double target_c;
    bool running;
    double cycling_since_s;
  };
  void append(Segment next);
  const Segment& segment_at(double t_s) const;
  double without_cycling(const Segment& segment, double t_s) const;

  ChamberPhysics physics_;
  std::vector<Segment> segments_;
};

}  // namespace gyrocal::rig
