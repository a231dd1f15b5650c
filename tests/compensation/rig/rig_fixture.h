#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compensation/rig/effects/catalogue.h"
#include "compensation/rig/rig_board.h"

namespace gyrocal::rig {

/// A rig without noise whose counts are fine enough to see 0.02 mdps.
inline RigModel silent_rig() {
  RigModel model;
  model.baseline.noise_dps = 0.0;
  model.baseline.lsb_per_dps = 30000.0;
  model.baseline.code_limit = 32000;
  for (CubicBias& bias : model.baseline.bias) bias.dps[0] = 0.0;
  return model;
}

inline EffectUse use(std::string effect, std::string law,
                     std::vector<std::pair<std::string, double>> parameters) {
  return {std::move(effect), std::move(law), std::move(parameters), {true, true, true}, {}};
}

inline RigModel with(RigModel model, EffectUse effect) {
  model.effects.push_back(std::move(effect));
  return model;
}

/// Air that goes up, down past the start, and up again, with time to settle.
inline ChamberAir up_and_down() {
  ChamberAir air(ChamberPhysics{});
  air.run(0.0, Celsius{40.0});
  air.run(3600.0, Celsius{-8.0});
  air.run(10800.0, Celsius{15.0});
  return air;
}

inline std::vector<RigSample> samples_of(const RigModel& model, const ChamberAir& air,
                                         double start_s, int count, double rate_hz = 50.0,
                                         std::uint32_t board_index = 0) {
  RigBoard board(model, 1, board_index);
  const auto start_ns = static_cast<std::int64_t>(start_s * 1e9);
  board.advance(air, start_ns);
  board.start(start_ns, rate_hz);
  std::vector<RigSample> samples;
  board.take(air, count, samples);
  return samples;
}

inline const Law& law_of(const std::string& effect, const std::string& law) {
  return *find_law(*find_effect(effect), law);
}

}  // namespace gyrocal::rig
