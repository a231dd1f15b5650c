#include "compensation/discrepancy/slow_stream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/median.h"
#include "compensation/discrepancy/sample_rows.h"
#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

constexpr double bin_s_usual = 20;
constexpr double bins_min = 48;
constexpr double bins_max = 2500;

struct Place {
  std::size_t left;
  double right_share;
};

Place place_on(const Track& track, double t_s) {
  const double at = std::clamp((t_s - track.t0_s) / track.step_s, 0.0,
                               static_cast<double>(track.record.size() - 1));
  const auto left = std::min(static_cast<std::size_t>(at), track.record.size() - 2);
  return {left, at - static_cast<double>(left)};
}

/// Distance of each value from the median of its two neighbours on either side.
std::vector<double> distances(const std::vector<double>& y) {
  std::vector<double> distance(y.size(), 0.0);
  for (std::size_t i = 2; i + 2 < y.size(); ++i) {
    std::array<double, 4> near{y[i - 2], y[i - 1], y[i + 1], y[i + 2]};
    std::sort(near.begin(), near.end());
    distance[i] = y[i] - (near[1] + near[2]) / 2;
  }
  return distance;
}

}  // namespace

SlowStream::SlowStream(const Session& session, std::span<const std::size_t> rows,
                       const Track& track, double bin_s, std::span<const double> noise_factor) {
  GYROCAL_ASSERT(track.record.size() >= 2);
  std::vector<double> t, weight, y, count, row_y;
  double opened_s = 0, last_s = 0;
  for (const std::size_t at : rows) {
    const MonitorRow& row = session.monitor[at];
    const bool next = t.empty() || row.t_s - opened_s > bin_s - session.monitor_interval_s / 2 ||
                      row.t_s - last_s > 1.5 * session.monitor_interval_s;
    if (next) {
      t.push_back(0), weight.push_back(0), y.push_back(0), count.push_back(0);
      opened_s = row.t_s;
    }
    last_s = row.t_s;
    t.back() += row.t_s;
    y.back() += row.gyro_dps;
    count.back() += 1;
    const Place place = place_on(track, row.t_s);
    const double noise_power = std::pow(noise_factor[place.left], 2);
    weight.back() += noise_power;
    row_grid_.t_s.push_back(row.t_s);
    row_grid_.weight_s.push_back(session.monitor_interval_s / noise_power);
    row_y.push_back(row.gyro_dps);
    taps_.push_back({static_cast<std::uint32_t>(t.size() - 1),
                     static_cast<std::uint32_t>(place.left), 1 - place.right_share,
                     place.right_share});
  }
  y_dps_.resize(static_cast<Eigen::Index>(y.size()));
  for (std::size_t i = 0; i < y.size(); ++i) {
    t[i] /= count[i];
    weight[i] = session.monitor_interval_s * count[i] * count[i] / weight[i];
    y_dps_(static_cast<Eigen::Index>(i)) = y[i] / count[i];
  }
  row_y_dps_ = Eigen::Map<const Eigen::VectorXd>(row_y.data(), std::ssize(row_y));
  rows_in_bin_ = Eigen::Map<const Eigen::VectorXd>(count.data(), std::ssize(count));
  grid_ = {std::move(t), std::move(weight)};
}

Eigen::VectorXd SlowStream::bin(std::span<const double> course) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(y_dps_.size());
  for (const Tap& tap : taps_) {
    sums(tap.bin) += tap.of(course);
  }
  return sums.cwiseQuotient(rows_in_bin_);
}

Eigen::VectorXd SlowStream::at_rows(std::span<const double> course) const {
  Eigen::VectorXd rows(row_y_dps_.size());
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    rows(static_cast<Eigen::Index>(i)) = taps_[i].of(course);
  }
  return rows;
}

Eigen::MatrixXd SlowStream::spread_to_rows(const Eigen::MatrixXd& bins) const {
  Eigen::MatrixXd rows(row_y_dps_.size(), bins.cols());
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = bins.row(taps_[i].bin);
  }
  return rows;
}

Eigen::VectorXd SlowStream::bin_rows(const Eigen::VectorXd& rows) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(y_dps_.size());
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    sums(taps_[i].bin) += rows(static_cast<Eigen::Index>(i));
  }
  return sums.cwiseQuotient(rows_in_bin_);
}

RowChoice training_rows(const Session& session, std::span<const Segment> segments,
                        double lone_outlier_sd) {
  std::vector<std::size_t> usable;
  std::vector<double> y;
  for (std::size_t i = 0; i < session.monitor.size(); ++i) {
    const MonitorRow& row = session.monitor[i];
    if (std::isnan(row.gyro_dps) || !may_train_on(segments, row.t_s)) continue;
    usable.push_back(i);
    y.push_back(row.gyro_dps);
  }
  const std::vector<double> distance = distances(y);
  std::vector<double> size(distance.size());
  std::transform(distance.begin(), distance.end(), size.begin(),
                 [](double d) { return std::abs(d); });
  const double limit = size.empty() ? 0 : lone_outlier_sd * 1.4826 * median_of(size);
  RowChoice choice;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (limit > 0 && size[i] > limit) {
      ++choice.lone_outliers;
    } else {
      choice.rows.push_back(usable[i]);
    }
  }
  return choice;
}

double row_white_sd_dps(const Session& session, std::span<const std::size_t> rows) {
  std::vector<double> size;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i] != rows[i - 1] + 1) continue;
    size.push_back(
        std::abs(session.monitor[rows[i]].gyro_dps - session.monitor[rows[i - 1]].gyro_dps));
  }
  if (size.empty()) return 0;
  return 1.4826 * median_of(std::move(size)) / std::numbers::sqrt2 *
         std::sqrt(session.monitor_interval_s);
}

double bin_width_s(const Session& session) {
  const double span_s = session.monitor.back().t_s - session.monitor.front().t_s;
  const double usual_s = std::max(bin_s_usual, span_s / bins_max);
  const auto rows = static_cast<double>(rows_with_gyro(session));
  return std::max(session.monitor_interval_s,
                  std::min(usual_s, rows * session.monitor_interval_s / bins_min));
}

double course_at(const Track& track, std::span<const double> course, double t_s) {
  const Place place = place_on(track, t_s);
  return (1 - place.right_share) * course[place.left] + place.right_share * course[place.left + 1];
}

}  // namespace gyrocal
