#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "compensation/discrepancy/segments.h"
#include "compensation/rig/effects/effect.h"
#include "compensation/rig/rig_model.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// The board's sensor against what the chamber's record makes of it.
struct BoardSensorFit {
  double tau_s = 0;         ///< air -> board
  bool tau_fitted = false;  ///< false: taken from the rig model
  double offset_c = 0;      ///< mean of sensor minus predicted board temperature
  double offset_sd_c = 0;   ///< standard error, rounding included
  double gain = 0;          ///< slope of sensor minus predicted over temperature, minus 0
  double gain_sd = 0;
  double step_c = 0;      ///< the sensor's rounding step as seen; 0 if continuous
  double nats = 0;        ///< gain of offset and gain over none, scaled by the rounding's size
  bool observed = false;  ///< there are board and chamber readings to compare
};

/// What drives every effect, on an even grid over the whole record, made from the temperatures
/// alone: the chamber's record through the two lags, never a differenced coarse sensor.
struct Track {
  std::vector<rig::Drivers> record;
  double t0_s = 0;
  double step_s = 10;
  double die_tau_s = 0;  ///< board -> die, as the rig model has it
  BoardSensorFit board_sensor;
  std::string lost;  ///< what could not be used and what that costs; empty if nothing
};

/// @param session  checked (see check_session).
[[nodiscard]] Track make_track(const Session& session, std::span<const Segment> segments,
                               const rig::Baseline& baseline);

}  // namespace gyrocal
