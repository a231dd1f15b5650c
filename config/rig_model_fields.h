#pragma once

#include <array>
#include <string_view>

#include "compensation/rig/rig_model.h"

namespace gyrocal {

/// The plain numbers of a rig model's baseline: one table for reading, writing, showing, comparing.
template <class Owner>
struct NumberField {
  std::string_view name;  ///< with its unit as suffix
  double Owner::*member;
  double low;
  double high;
};

inline constexpr std::array<NumberField<rig::ChamberPhysics>, 7> chamber_fields{{
    {"heating_c_per_min", &rig::ChamberPhysics::heating_c_per_min, 1e-3, 100.0},
    {"cooling_c_per_min", &rig::ChamberPhysics::cooling_c_per_min, 1e-3, 100.0},
    {"approach_tau_s", &rig::ChamberPhysics::approach_tau_s, 0.1, 1e5},
    {"cycling_c", &rig::ChamberPhysics::cycling_c, 0.0, 10.0},
    {"cycling_period_s", &rig::ChamberPhysics::cycling_period_s, 1.0, 1e6},
    {"ambient_c", &rig::ChamberPhysics::ambient_c, -60.0, 100.0},
    {"ambient_tau_s", &rig::ChamberPhysics::ambient_tau_s, 1.0, 1e7},
}};

inline constexpr std::array<NumberField<rig::Baseline>, 6> baseline_fields{{
    {"board_tau_s", &rig::Baseline::board_tau_s, 0.1, 1e5},
    {"die_tau_s", &rig::Baseline::die_tau_s, 0.1, 1e5},
    {"bias_spread_dps", &rig::Baseline::bias_spread_dps, 0.0, 100.0},
    {"noise_dps", &rig::Baseline::noise_dps, 0.0, 1000.0},
    {"lsb_per_dps", &rig::Baseline::lsb_per_dps, 1e-3, 1e5},
    {"board_sensor_step_c", &rig::Baseline::board_sensor_step_c, 1.0 / 256.0, 10.0},
}};

inline constexpr int code_limit_max = 32767;
inline constexpr double bias_dps_max = 2000.0;

}  // namespace gyrocal
