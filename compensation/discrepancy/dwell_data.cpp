#include "compensation/discrepancy/dwell_data.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gyrocal {
namespace {

constexpr std::size_t samples_min = 32;
constexpr double tilt_seen_g = 0.003;

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
  std::erase_if(all, [](const DwellData& data) { return data.y_dps.size() < samples_min; });
  for (DwellData& data : all) {
    data.t_start_s = data.t_s.front();
    detrend(data);
    add_drivers(track, data);
  }
  return all;
}

void add_acceleration(const Session& session, Track& track) {
  struct Mean {
    double t = 0, n = 0;
    std::array<double, 3> g{};
  };
  std::map<int, Mean> means;
  for (const SessionSample& sample : session.samples) {
    if (std::isnan(sample.acc_g[0] + sample.acc_g[1] + sample.acc_g[2])) continue;
    Mean& mean = means[sample.dwell];
    mean.t += sample.t_s;
    mean.n += 1;
    for (std::size_t axis = 0; axis < 3; ++axis) mean.g[axis] += sample.acc_g[axis];
  }
  std::vector<Mean> course;
  for (auto& [dwell, mean] : means) {
    mean.t /= mean.n;
    for (double& g : mean.g) g /= mean.n;
    course.push_back(mean);
  }
  std::sort(course.begin(), course.end(), [](const Mean& a, const Mean& b) { return a.t < b.t; });
  if (course.empty()) return;
  std::size_t right = 0;
  for (rig::Drivers& now : track.record) {
    while (right < course.size() && course[right].t < now.t_s) ++right;
    const Mean& before = course[right == 0 ? 0 : right - 1];
    const Mean& after = course[std::min(right, course.size() - 1)];
    const double share = after.t > before.t ? (now.t_s - before.t) / (after.t - before.t) : 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now.acc_g[axis] = before.g[axis] + share * (after.g[axis] - before.g[axis]);
    }
  }
}

bool acceleration_varies(const Track& track) {
  std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const rig::Drivers& now : track.record) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], now.acc_g[axis]);
      high[axis] = std::max(high[axis], now.acc_g[axis]);
    }
  }
  return high[0] - low[0] > tilt_seen_g || high[1] - low[1] > tilt_seen_g ||
         high[2] - low[2] > tilt_seen_g;
}

}  // namespace gyrocal
