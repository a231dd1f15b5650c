#include "compensation/discrepancy/acceleration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace gyrocal {
namespace {

constexpr double tilt_seen_g = 0.003;
constexpr double slip_g = 0.02;
constexpr double coarse_step_s = 60, fine_step_s = 10, fine_reach_s = 90;
constexpr double instants_max = 60;

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

/// The course between the dwells' means, its slips at given instants.
class Course {
 public:
  explicit Course(std::vector<Mean> means) : means_(std::move(means)) {
    for (std::size_t k = 1; k < means_.size(); ++k) {
      if (distance_g(means_[k - 1], means_[k]) < slip_g) continue;
      slips_.push_back({k, (means_[k - 1].end_s + means_[k].begin_s) / 2});
    }
  }
  [[nodiscard]] std::size_t slips() const { return slips_.size(); }
  /// Between which instants a slip must lie.
  [[nodiscard]] std::pair<double, double> bounds_s(std::size_t slip) const {
    const std::size_t k = slips_[slip].before_mean;
    return {means_[k - 1].end_s, means_[k].begin_s};
  }
  double& slip_s(std::size_t slip) { return slips_[slip].at_s; }

  void put_into(Track& track) const {
    struct Knot {
      double t_s;
      std::array<double, 3> g;
    };
    std::vector<Knot> knots;
    std::size_t next_slip = 0;
    for (std::size_t k = 0; k < means_.size(); ++k) {
      if (next_slip < slips_.size() && slips_[next_slip].before_mean == k) {
        const double at_s = slips_[next_slip++].at_s;
        knots.push_back({at_s, means_[k - 1].g});
        knots.push_back({at_s + 1, means_[k].g});
      }
      knots.push_back({(means_[k].begin_s + means_[k].end_s) / 2, means_[k].g});
    }
    std::size_t right = 0;
    for (rig::Drivers& now : track.record) {
      while (right < knots.size() && knots[right].t_s < now.t_s) ++right;
      const Knot& a = knots[right == 0 ? 0 : right - 1];
      const Knot& b = knots[std::min(right, knots.size() - 1)];
      const double share = b.t_s > a.t_s ? (now.t_s - a.t_s) / (b.t_s - a.t_s) : 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        now.acc_g[axis] = a.g[axis] + share * (b.g[axis] - a.g[axis]);
      }
    }
  }

 private:
  struct Slip {
    std::size_t before_mean;
    double at_s;
  };
  std::vector<Mean> means_;
  std::vector<Slip> slips_;
};

/// What cubic and accelerometer leave of the stream, white noise taken for granted.
double misfit(const SlowStream& stream, const Track& track) {
  constexpr Eigen::Index powers = 4;
  Eigen::MatrixXd design(stream.size(), powers + 3);
  std::vector<double> course(track.record.size(), 1.0);
  for (Eigen::Index power = 0; power < powers; ++power) {
    design.col(power) = stream.bin(course);
    for (std::size_t i = 0; i < course.size(); ++i) course[i] *= (track.record[i].die_c - 20) / 30;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < course.size(); ++i) course[i] = track.record[i].acc_g[axis];
    design.col(powers + static_cast<Eigen::Index>(axis)) = stream.bin(course);
  }
  const auto n = static_cast<Eigen::Index>(stream.grid().weight_s.size());
  const Eigen::ArrayXd root =
      Eigen::Map<const Eigen::ArrayXd>(stream.grid().weight_s.data(), n).sqrt();
  const Eigen::MatrixXd x = root.matrix().asDiagonal() * design;
  const Eigen::VectorXd y = root.matrix().asDiagonal() * stream.y_dps();
  const Eigen::MatrixXd gram = x.transpose() * x;
  const double ridge = 1e-10 * gram.trace();  // an axis that never changed is a second constant
  const Eigen::MatrixXd ridged = gram + ridge * Eigen::MatrixXd::Identity(powers + 3, powers + 3);
  return (y - x * ridged.ldlt().solve(x.transpose() * y)).squaredNorm();
}

/// Moves one slip to the best of instants `step_s` apart.
void place_slip(const SlowStream& stream, Track& track, Course& course, std::size_t slip,
                double from_s, double to_s, double step_s) {
  double best_s = course.slip_s(slip), best = -1;
  for (double at_s = from_s; at_s <= to_s; at_s += step_s) {
    course.slip_s(slip) = at_s;
    course.put_into(track);
    const double left = misfit(stream, track);
    if (best < 0 || left < best) best = left, best_s = at_s;
  }
  course.slip_s(slip) = best_s;
}

}  // namespace

void add_acceleration(const Session& session, const SlowStream& stream, Track& track) {
  std::vector<Mean> means = dwell_means(session);
  if (means.empty()) return;
  Course course(std::move(means));
  for (std::size_t slip = 0; slip < course.slips(); ++slip) {
    const auto [from_s, to_s] = course.bounds_s(slip);
    place_slip(stream, track, course, slip, from_s, to_s,
               std::max(coarse_step_s, (to_s - from_s) / instants_max));
  }
  for (std::size_t slip = 0; slip < course.slips(); ++slip) {
    const auto [from_s, to_s] = course.bounds_s(slip);
    const double at_s = course.slip_s(slip);
    place_slip(stream, track, course, slip, std::max(from_s, at_s - fine_reach_s),
               std::min(to_s, at_s + fine_reach_s), fine_step_s);
  }
  course.put_into(track);
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
