#include "compensation/discrepancy/dwell_data.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gyrocal {
namespace {

constexpr std::size_t fitted_samples_min = 32;

void detrend(DwellData& data) {
  const auto n = static_cast<double>(data.y_dps.size());
  double mean = 0, middle = 0;
  for (std::size_t i = 0; i < data.y_dps.size(); ++i) {
    mean += data.y_dps[i] / n;
    middle += data.t_s[i] / n;
  }
  double above = 0, below = 0;
  for (std::size_t i = 0; i < data.y_dps.size(); ++i) {
    const double t = data.t_s[i] - middle;
    above += t * (data.y_dps[i] - mean);
    below += t * t;
  }
  data.mean_dps = mean;
  data.slope_dps_per_s = below > 0 ? above / below : 0;
  data.residual_dps.resize(data.y_dps.size());
  for (std::size_t i = 0; i < data.y_dps.size(); ++i) {
    data.residual_dps[i] = data.y_dps[i] - mean - data.slope_dps_per_s * (data.t_s[i] - middle);
  }
}

void add_drivers(const Track& track, DwellData& data) {
  double die = 0, cooling = 0, n = 0;
  for (const rig::Drivers& now : track.record) {
    if (now.t_s < data.t_s.front() - track.step_s || now.t_s > data.t_s.back() + track.step_s) {
      continue;
    }
    die += now.die_c;
    cooling += now.chamber_rate_c_per_min < 0;
    n += 1;
  }
  data.die_c = n > 0 ? die / n : missing;
  data.cooling = n > 0 ? cooling / n : 0;
}

}  // namespace

std::vector<DwellData> dwell_data(const Session& session, std::span<const Segment> segments,
                                  const Track& track, bool held_out) {
  std::map<int, bool> wanted;
  for (const Segment& segment : segments) wanted[segment.dwell] = segment.held_out == held_out;
  std::vector<DwellData> all;
  std::map<int, std::size_t> place;
  for (const SessionSample& sample : session.samples) {
    const auto found = wanted.find(sample.dwell);
    if (found == wanted.end() || !found->second || std::isnan(sample.gyro_dps)) continue;
    const auto [at, fresh] = place.emplace(sample.dwell, all.size());
    if (fresh) {
      all.emplace_back();
      all.back().dwell = sample.dwell;
    }
    DwellData& data = all[at->second];
    data.t_s.push_back(sample.t_s);
    data.y_dps.push_back(sample.gyro_dps);
    data.seq.push_back(sample.seq);
  }
  std::erase_if(all, [](const DwellData& data) { return data.y_dps.size() < fitted_samples_min; });
  for (DwellData& data : all) {
    data.t_start_s = data.t_s.front();
    detrend(data);
    add_drivers(track, data);
  }
  return all;
}

}  // namespace gyrocal
