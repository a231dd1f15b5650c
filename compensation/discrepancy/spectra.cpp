#include "compensation/discrepancy/spectra.h"

#include <algorithm>

#include "compensation/discrepancy/dwell_data.h"
#include "compensation/discrepancy/dwell_power.h"
#include "compensation/discrepancy/dwell_spectrum.h"
#include "compensation/discrepancy/simulated_dwell.h"

namespace gyrocal {
namespace {

constexpr std::size_t points_max = 400;
constexpr std::uint64_t curve_replicas =
    8;  // so that the simulated curve is smoother than the measured

/// Adds the power of n samples, mean taken off.
void add_power(std::span<const double> y, std::span<const std::int64_t> seq, std::size_t n,
               std::vector<double>& power) {
  double mean = 0;
  for (const double value : y) mean += value / static_cast<double>(y.size());
  const std::vector<double> added = dwell_power(y, seq, mean, n, n);
  for (std::size_t k = 0; k < power.size(); ++k) power[k] += added[k];
}

/// Means over neighbouring bins, from the first that the mean taken off has not emptied.
std::vector<double> thinned(const std::vector<double>& power, std::size_t together, double scale) {
  std::vector<double> points;
  for (std::size_t first = 1; first + together <= power.size(); first += together) {
    double sum = 0;
    for (std::size_t k = first; k < first + together; ++k) sum += power[k];
    points.push_back(sum * scale / static_cast<double>(together));
  }
  return points;
}

}  // namespace

std::vector<SpectrumPoint> compare_spectra(const Session& session,
                                           std::span<const Segment> segments, const Track& track,
                                           std::span<const Simulation> simulations) {
  const std::vector<DwellData> dwells = dwell_data(session, segments, track, true);
  std::size_t n = 0;
  for (const DwellData& dwell : dwells) {
    const auto length = static_cast<std::size_t>(dwell.seq.back() - dwell.seq.front() + 1);
    n = n == 0 ? length : std::min(n, length);
  }
  n -= n % 2;
  if (n < spectrum_samples_min) return {};
  const std::size_t bins = n / 2, together = (bins + points_max - 1) / points_max;
  const double rate_hz = session.sample_rate_hz;
  const auto per_hz = [&](std::uint64_t runs) {
    return 2 / (rate_hz * static_cast<double>(n * dwells.size() * runs));
  };
  std::vector<double> power(bins, 0.0);
  for (const DwellData& dwell : dwells) add_power(dwell.y_dps, dwell.seq, n, power);
  const std::vector<double> measured = thinned(power, together, per_hz(1));
  std::vector<SpectrumPoint> points(measured.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double middle = 1 + static_cast<double>(together) * (static_cast<double>(k) + 0.5) - 0.5;
    points[k] = {middle * rate_hz / static_cast<double>(n), measured[k], {}};
  }
  for (const Simulation& simulation : simulations) {
    const auto instances = rig::instantiate(simulation.fast);
    if (!instances) return {};
    std::fill(power.begin(), power.end(), 0.0);
    for (std::size_t d = 0; d < dwells.size(); ++d) {
      for (std::uint64_t r = 0; r < curve_replicas; ++r) {
        const DwellReplica replica =
            simulate_dwell(dwells[d], track, simulation, *instances, rate_hz, 1000 * d + r);
        if (!replica.y.empty()) add_power(replica.y, replica.seq, n, power);
      }
    }
    const std::vector<double> simulated = thinned(power, together, per_hz(curve_replicas));
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k].simulated_dps2_per_hz.push_back(simulated[k]);
    }
  }
  return points;
}

}  // namespace gyrocal
