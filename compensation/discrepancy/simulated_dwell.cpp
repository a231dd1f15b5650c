#include "compensation/discrepancy/simulated_dwell.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/slow_stream.h"
#include "compensation/rig/random.h"

namespace gyrocal {
namespace {

constexpr std::uint32_t replica_purpose = 900;

}  // namespace

DwellReplica simulate_dwell(const DwellData& dwell, const Track& track,
                            const Simulation& simulation, std::span<const rig::Instance> instances,
                            double sample_rate_hz, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(dwell.seq.back() + 1);
  rig::RandomStream noise({seed, 0, 0, replica_purpose});
  rig::AxisEffects effects(simulation.fast, instances, seed, 0, 2,
                           simulation.fast.baseline.bias[2]);
  const double block_s = track.step_s;
  const double start_s = dwell.t_start_s - static_cast<double>(dwell.seq.front()) / sample_rate_hz;
  std::vector<double> y(count), t(count);
  std::vector<std::uint8_t> lost(count, 0);
  for (std::size_t i = 0; i < count; ++i) t[i] = start_s + static_cast<double>(i) / sample_rate_hz;
  const auto block = static_cast<std::size_t>(std::max(1.0, block_s * sample_rate_hz));
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t size = std::min(block, count - first);
    const auto at = static_cast<std::size_t>(std::clamp(
        (t[first] - track.t0_s) / track.step_s, 0.0, static_cast<double>(track.record.size() - 1)));
    effects.advance(track.record[at], first == 0 ? 0.0 : block_s);
    const double sd = simulation.sample_sd_dps * effects.noise_factor();
    const std::span<double> part(y.data() + first, size);
    for (std::size_t i = 0; i < size; ++i) {
      part[i] = course_at(track, simulation.course_dps, t[first + i]) + sd * noise.normal();
    }
    effects.add(std::span<const double>(t.data() + first, size), sd, part);
    if (simulation.lsb_dps > 0) {
      std::vector<double> exact(size), codes(size);
      for (std::size_t i = 0; i < size; ++i) {
        exact[i] = part[i] / simulation.lsb_dps;
        codes[i] = std::round(exact[i]);
      }
      effects.convert(exact, codes, simulation.lsb_dps);
      effects.change(codes);
      for (std::size_t i = 0; i < size; ++i) part[i] = codes[i] * simulation.lsb_dps;
    } else {
      effects.change(part);
    }
    effects.lose(std::span<std::uint8_t>(lost.data() + first, size));
  }
  DwellReplica replica;
  for (std::size_t i = 0; i < count; ++i) {
    if (lost[i] != 0) continue;
    replica.y.push_back(y[i]);
    replica.seq.push_back(static_cast<std::int64_t>(i));
  }
  return replica;
}

}  // namespace gyrocal
