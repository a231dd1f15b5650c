#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compensation/rig/chamber_air.h"
#include "compensation/values/units.h"

namespace gyrocal::rig {

/// Bias over die temperature: c0 + c1 u + c2 u^2 + c3 u^3 [deg/s], u = (T - 20 degC)/30 degC, so
/// that -10..50 degC is u = -1..1.
struct CubicBias {
  static constexpr double center_c = 20.0;
  static constexpr double half_span_c = 30.0;
  std::array<double, 4> dps{};

  [[nodiscard]] double at(double die_c) const {
    const double u = (die_c - center_c) / half_span_c;
    return dps[0] + u * (dps[1] + u * (dps[2] + u * dps[3]));
  }
  /// db/dT [deg/s per degC].
  [[nodiscard]] double slope(double die_c) const {
    const double u = (die_c - center_c) / half_span_c;
    return (dps[1] + u * (2.0 * dps[2] + u * 3.0 * dps[3])) / half_span_c;
  }
  bool operator==(const CubicBias&) const = default;
};

/// What the rig does before any effect is added.
struct Baseline {
  ChamberPhysics chamber;
  double board_tau_s = 240.0;  ///< air -> board
  double die_tau_s = 40.0;     ///< board -> die
  /// z: least squares through the paper's Table 1 (4.06..4.39 deg/s over -10..50 degC).
  std::array<CubicBias, 3> bias{CubicBias{{3.2140, 0.1620, -0.0710, -0.0280}},
                                CubicBias{{-2.4470, 0.1180, 0.0890, -0.0390}},
                                CubicBias{{4.1308, -0.2036, 0.1056, 0.0458}}};
  double bias_spread_dps = 0.05;  ///< 1 sigma from board to board; board 0 has the bias as written
  double noise_dps = 1.31;        ///< white, per sample at any rate (the ADC does not average)
  double lsb_per_dps = 4.13;
  int code_limit = 4095;             ///< the board sends codes in [-limit, limit]
  double board_sensor_step_c = 0.5;  ///< STLM75
  bool operator==(const Baseline&) const = default;
};

/// One effect of the catalogue with the numbers of its law's parameters (compensation/rig/effects).
struct EffectUse {
  std::string effect;  ///< a name of DESIGN section 10
  std::string law{};
  std::vector<std::pair<std::string, double>> parameters{};  ///< those left out have their default
  std::array<bool, 3> axes{true, true, true};                ///< which gyro axes feel it
  std::vector<std::uint32_t> boards{};                       ///< board indices; empty: all
  bool operator==(const EffectUse&) const = default;
};

/// What an empirical term may hang on.
enum class EmpiricalDriver { campaign_time, time_on, die, die_rate, chamber_minus_board, phase };

/// A drift, a line or a change of the noise that was seen but has no name: a curve over one driver,
/// straight between its knots. A diagnosis adds it so that the gap shrinks honestly; no physics is
/// claimed (compensation/rig/empirical_term.h).
struct EmpiricalTerm {
  EmpiricalDriver driver = EmpiricalDriver::die;
  double period_s = 0.0;    ///< of driver phase; else unused
  std::vector<double> at;   ///< knots, ascending, in the driver's unit
  std::vector<double> dps;  ///< drift there
  std::array<bool, 3> axes{true, true, true};
  std::vector<double> noise_factor{};  ///< instead of dps: times the white noise there
  bool operator==(const EmpiricalTerm&) const = default;
};

/// The simulation: baseline plus effects. Kept as a file (config/rig_model.h) and in the database.
struct RigModel {
  std::string name = "default";
  std::string parent;       ///< name of the model this one was made from; empty: none
  std::string parent_hash;  ///< its hash (config/rig_model.h); empty: none
  Baseline baseline;
  std::vector<EffectUse> effects;
  std::vector<EmpiricalTerm> unexplained;
  bool operator==(const RigModel&) const = default;
};

}  // namespace gyrocal::rig
