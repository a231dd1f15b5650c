#include "compensation/discrepancy/acceleration.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "compensation/discrepancy/slow_stream.h"

namespace gyrocal {
namespace {

constexpr double tilt_seen_g = 0.003;
constexpr double slip_g = 0.02;
constexpr double slip_over_usual = 4;
constexpr std::size_t rows_min = 12;

struct Mean {
  double begin_s = 0, end_s = 0, n = 0;
  std::array<double, 3> g{};
};

std::vector<Mean> dwell_means(const Session& session) {
  std::map<int, Mean> means;
  for (const SessionSample& sample : session.samples) {
    if (std::isnan(sample.acc_g[0] + sample.acc_g[1] + sample.acc_g[2])) continue;
    Mean& mean = means[sample.dwell];
    if (mean.n == 0) mean.begin_s = sample.t_s;
    mean.end_s = sample.t_s;
    mean.n += 1;
    for (std::size_t axis = 0; axis < 3; ++axis) mean.g[axis] += sample.acc_g[axis];
  }
  std::vector<Mean> course;
  for (auto& [dwell, mean] : means) {
    for (double& g : mean.g) g /= mean.n;
    course.push_back(mean);
  }
  std::sort(course.begin(), course.end(),
            [](const Mean& a, const Mean& b) { return a.begin_s < b.begin_s; });
  return course;
}

double distance_g(const Mean& a, const Mean& b) {
  return std::hypot(a.g[0] - b.g[0], a.g[1] - b.g[1], a.g[2] - b.g[2]);
}

/// How far a change between neighbours must go to be a slip.
double slip_threshold_g(const std::vector<Mean>& course) {
  std::vector<double> change;
  for (std::size_t k = 1; k < course.size(); ++k) {
    change.push_back(distance_g(course[k - 1], course[k]));
  }
  const auto middle = change.begin() + static_cast<std::ptrdiff_t>(change.size() / 2);
  std::nth_element(change.begin(), middle, change.end());
  return std::max(slip_g, slip_over_usual * *middle);
}

/// When a step parts the gyro's rows between two dwells best, a parabola over the die temperature
/// fitted with it; the middle where too few rows may be looked at.
double slip_instant_s(const Session& session, std::span<const Segment> segments, const Track& track,
                      const Mean& before, const Mean& after) {
  const double middle_s = (before.end_s + after.begin_s) / 2;
  std::vector<double> t, die, y;
  for (const MonitorRow& row : session.monitor) {
    if (row.t_s < before.begin_s || row.t_s > after.end_s || std::isnan(row.gyro_dps) ||
        !may_train_on(segments, row.t_s)) {
      continue;
    }
    const auto at = static_cast<std::size_t>(std::clamp(
        (row.t_s - track.t0_s) / track.step_s, 0.0, static_cast<double>(track.record.size() - 1)));
    t.push_back(row.t_s);
    die.push_back(track.record[at].die_c);
    y.push_back(row.gyro_dps);
  }
  if (t.size() < rows_min) return middle_s;
  const auto n = static_cast<Eigen::Index>(t.size());
  const double centre = die[die.size() / 2];
  Eigen::MatrixXd smooth(n, 3);
  Eigen::MatrixXd late(n, n - 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = die[static_cast<std::size_t>(i)] - centre;
    smooth.row(i) << 1, x, x * x;
    for (Eigen::Index k = 0; k + 1 < n; ++k) late(i, k) = i > k ? 1.0 : 0.0;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(smooth);
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(n, 3);
  const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(y.data(), n);
  const Eigen::VectorXd rest = values - basis * (basis.transpose() * values);
  late -= basis * (basis.transpose() * late).eval();
  double best = 0, best_s = middle_s;
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    const double norm = late.col(k).squaredNorm();
    if (norm < 1e-6 * static_cast<double>(n)) continue;
    const double explained = std::pow(late.col(k).dot(rest), 2) / norm;
    const auto at = static_cast<std::size_t>(k);
    const double between_s = (t[at] + t[at + 1]) / 2;
    if (explained > best && between_s > before.end_s && between_s < after.begin_s) {
      best = explained, best_s = between_s;
    }
  }
  return best_s;
}

}  // namespace

void add_acceleration(const Session& session, std::span<const Segment> segments, Track& track) {
  const std::vector<Mean> course = dwell_means(session);
  if (course.empty()) return;
  struct Knot {
    double t_s;
    std::array<double, 3> g;
  };
  std::vector<Knot> knots{{course.front().begin_s, course.front().g}};
  const double threshold_g = course.size() > 2 ? slip_threshold_g(course) : slip_g;
  for (std::size_t k = 0; k < course.size(); ++k) {
    if (k > 0 && distance_g(course[k - 1], course[k]) > threshold_g) {
      const double slip_s = slip_instant_s(session, segments, track, course[k - 1], course[k]);
      knots.push_back({slip_s, course[k - 1].g});
      knots.push_back({slip_s + 1, course[k].g});
    }
    knots.push_back({(course[k].begin_s + course[k].end_s) / 2, course[k].g});
  }
  std::size_t right = 0;
  for (rig::Drivers& now : track.record) {
    while (right < knots.size() && knots[right].t_s < now.t_s) ++right;
    const Knot& left = knots[right == 0 ? 0 : right - 1];
    const Knot& next = knots[std::min(right, knots.size() - 1)];
    const double share = next.t_s > left.t_s ? (now.t_s - left.t_s) / (next.t_s - left.t_s) : 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now.acc_g[axis] = left.g[axis] + share * (next.g[axis] - left.g[axis]);
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
