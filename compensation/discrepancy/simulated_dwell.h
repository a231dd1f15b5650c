#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compensation/discrepancy/dwell_data.h"
#include "compensation/discrepancy/gap.h"
#include "compensation/rig/active_effects.h"

namespace gyrocal {

/// What a simulated board sent in one dwell.
struct DwellReplica {
  std::vector<double> y;          ///< [deg/s], those that arrived
  std::vector<std::int64_t> seq;  ///< their numbers, from 0
};

/// One simulated run of a measured dwell; the same seed gives the same samples.
[[nodiscard]] DwellReplica simulate_dwell(const DwellData& dwell, const Track& track,
                                          const Simulation& simulation,
                                          std::span<const rig::Instance> instances,
                                          double sample_rate_hz, std::uint64_t seed);

}  // namespace gyrocal
