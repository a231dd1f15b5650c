#include "compensation/discrepancy/gap.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/dwell_data.h"
#include "compensation/discrepancy/dwell_features.h"
#include "compensation/discrepancy/simulated_dwell.h"
#include "compensation/discrepancy/slow_smoother.h"
#include "compensation/discrepancy/slow_stream.h"
#include "compensation/rig/active_effects.h"

namespace gyrocal {
namespace {

constexpr int gap_replicas = 40;
constexpr int minutes_per_segment = 20;
constexpr double square_cap = 400;

/// E[z^2] where mean and deviation come from this many replicas themselves.
constexpr double replica_inflation =
    (1.0 + 1.0 / gap_replicas) * (gap_replicas - 1.0) / (gap_replicas - 3.0);

struct Minute {
  double measured = 0, simulated = 0, variance = 0, n = 0;
};

/// Evenly spread one-minute means of a segment: measured against simulated.
std::vector<Minute> minutes_of(const Session& session, const Segment& segment,
                               const std::vector<double>& simulated,
                               const std::vector<double>& variance) {
  std::vector<Minute> all;
  double opened_s = -1e300;
  for (std::size_t i = 0; i < session.monitor.size(); ++i) {
    const MonitorRow& row = session.monitor[i];
    if (row.t_s <= segment.begin_s || row.t_s > segment.end_s || std::isnan(row.gyro_dps)) continue;
    if (row.t_s - opened_s >= 60) all.emplace_back(), opened_s = row.t_s;
    Minute& minute = all.back();
    minute.measured += row.gyro_dps;
    minute.simulated += simulated[i];
    minute.variance += variance[i];
    minute.n += 1;
  }
  std::vector<Minute> chosen;
  const std::size_t wanted = std::min<std::size_t>(minutes_per_segment, all.size());
  for (std::size_t k = 0; k < wanted; ++k) {
    Minute minute = all[(2 * k + 1) * all.size() / (2 * wanted)];
    minute.measured /= minute.n, minute.simulated /= minute.n, minute.variance /= minute.n;
    chosen.push_back(minute);
  }
  return chosen;
}

void slow_gap(const Session& session, std::span<const Segment> segments, const Track& track,
              const Simulation& simulation, GapMeasure& measure) {
  std::vector<double> variance;
  const auto simulated = predicted_rows(session, segments, track, simulation, &variance);
  double squares = 0, n = 0, excess = 0;
  for (const Segment& segment : segments) {
    if (!segment.held_out) continue;
    for (const Minute& minute : minutes_of(session, segment, simulated, variance)) {
      const double white = simulation.white_sd_dps * simulation.white_sd_dps /
                           (minute.n * session.monitor_interval_s);
      const double off = minute.measured - minute.simulated;
      squares += std::min(off * off / (white + minute.variance), square_cap);
      excess += off * off - white;
      n += 1;
    }
  }
  if (n == 0) return;
  measure.slow = squares / n - 1;
  measure.slow_dps = std::sqrt(std::max(0.0, excess / n));
}

template <std::size_t N>
double channel_gap(const std::array<double, N>& measured,
                   const std::vector<std::array<double, N>>& simulated) {
  double squares = 0;
  for (std::size_t k = 0; k < N; ++k) {
    double mean = 0, second = 0;
    for (const auto& one : simulated) mean += one[k] / gap_replicas;
    for (const auto& one : simulated)
      second += (one[k] - mean) * (one[k] - mean) / (gap_replicas - 1);
    // Counts that never occur in the replicas still have a least step.
    const double variance = std::max(second, 0.02);
    const double off = measured[k] - mean;
    squares += std::min(off * off / variance, square_cap);
    if (second < 0.02) squares += 1 - std::min(1.0, second / 0.02);
  }
  return squares / static_cast<double>(N) / replica_inflation - 1;
}

void fast_gap(const Session& session, std::span<const Segment> segments, const Track& track,
              const Simulation& simulation, GapMeasure& measure) {
  const auto instances = rig::instantiate(simulation.fast);
  const auto dwells = dwell_data(session, segments, track, true);
  if (!instances || dwells.empty()) return;
  const auto n = static_cast<double>(dwells.size());
  double decibels = 0, spread = 0, loss = 0;
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    const DwellData& dwell = dwells[d];
    const DwellFeatures seen = dwell_features(dwell.y_dps, dwell.seq, simulation.lsb_dps);
    std::vector<std::array<double, DwellFeatures::bands + 1>> spectrum;
    std::vector<std::array<double, 5>> distribution;
    std::vector<std::array<double, 2>> link;
    std::array<double, DwellFeatures::bands> level{};
    double sd = 0, lost = 0;
    for (int r = 0; r < gap_replicas; ++r) {
      const DwellReplica replica =
          simulate_dwell(dwell, track, simulation, *instances, session.sample_rate_hz,
                         1000 * d + static_cast<std::size_t>(r));
      if (replica.y.size() < 32) continue;
      const DwellFeatures one = dwell_features(replica.y, replica.seq, simulation.lsb_dps);
      spectrum.push_back(one.spectrum);
      distribution.push_back(one.distribution);
      link.push_back(one.link);
      for (std::size_t b = 0; b < level.size(); ++b) level[b] += one.spectrum[b] / gap_replicas;
      sd += one.sd_dps / gap_replicas;
      lost += one.lost_share / gap_replicas;
    }
    measure.spectrum += channel_gap(seen.spectrum, spectrum) / n;
    measure.distribution += channel_gap(seen.distribution, distribution) / n;
    measure.link += channel_gap(seen.link, link) / n;
    for (std::size_t b = 0; b < level.size(); ++b) {
      const double db = 10 / std::log(10.0) * (seen.spectrum[b] - level[b]);
      decibels += db * db / (n * DwellFeatures::bands);
    }
    spread += std::abs(seen.sd_dps / sd - 1) / n;
    loss += std::abs(seen.lost_share - lost) / n;
  }
  measure.spectrum_db = std::sqrt(decibels);
  measure.distribution_share = spread;
  measure.link_share = loss;
}

}  // namespace

std::vector<double> predicted_rows(const Session& session, std::span<const Segment> segments,
                                   const Track& track, const Simulation& simulation,
                                   std::vector<double>* variance) {
  std::vector<double> rows(session.monitor.size());
  if (variance != nullptr) variance->assign(rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = course_at(track, simulation.course_dps, session.monitor[i].t_s);
  }
  if (simulation.shape.flicker_ratio > 0 || simulation.shape.walk_ratio > 0 ||
      !simulation.relaxing.empty()) {
    const double bin_s = bin_width_s(session);
    SlowGrid grid;
    std::vector<double> residual, count;
    std::vector<std::size_t> bin_of(rows.size());
    double opened_s = -1e300;
    bool trains = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const MonitorRow& row = session.monitor[i];
      const bool may = !std::isnan(row.gyro_dps) && may_train_on(segments, row.t_s);
      if (row.t_s - opened_s >= bin_s || may != trains || grid.t_s.empty()) {
        grid.t_s.push_back(row.t_s);
        grid.weight_s.push_back(0), residual.push_back(0), count.push_back(0);
        opened_s = row.t_s, trains = may;
      }
      bin_of[i] = grid.t_s.size() - 1;
      if (!may) continue;
      residual.back() += simulation.mean_law.rate(row.gyro_dps) - rows[i];
      count.back() += 1;
      grid.weight_s.back() += session.monitor_interval_s;
    }
    Eigen::VectorXd means(static_cast<Eigen::Index>(residual.size()));
    for (std::size_t k = 0; k < residual.size(); ++k) {
      means(static_cast<Eigen::Index>(k)) = count[k] > 0 ? residual[k] / count[k] : 0.0;
    }
    const DriftEstimate drift =
        estimate_drift(grid, simulation.shape, simulation.white_sd_dps, simulation.relaxing, means);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i] += drift.mean_dps(static_cast<Eigen::Index>(bin_of[i]));
      if (variance != nullptr) {
        (*variance)[i] = drift.variance_dps2(static_cast<Eigen::Index>(bin_of[i]));
      }
    }
  }
  for (double& row : rows) row = simulation.mean_law.measured(row);
  return rows;
}

GapMeasure measure_gap(const Session& session, std::span<const Segment> segments,
                       const Track& track, const Simulation& simulation) {
  GapMeasure measure;
  slow_gap(session, segments, track, simulation, measure);
  fast_gap(session, segments, track, simulation, measure);
  const double mean = (measure.slow + measure.spectrum + measure.distribution + measure.link) / 4;
  measure.total = std::sqrt(std::max(0.0, mean));
  return measure;
}

}  // namespace gyrocal
