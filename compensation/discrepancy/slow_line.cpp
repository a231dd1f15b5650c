#include "compensation/discrepancy/slow_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/off_design.h"
#include "compensation/discrepancy/simplex.h"

namespace gyrocal {
namespace {

constexpr double turns_min = 4;
constexpr double line_worth_refining_nats = 8;
constexpr double cycling_over_neighbours = 20;

std::vector<double> course_of(const Track& track, double f_hz, double phase_turns) {
  std::vector<double> course;
  course.reserve(track.record.size());
  for (const rig::Drivers& now : track.record) {
    course.push_back(
        std::cos(2 * std::numbers::pi * (f_hz * (now.t_s - track.t0_s) - phase_turns)));
  }
  return course;
}

Eigen::MatrixXd columns_at(const SlowStream& stream, const Track& track, double f_hz) {
  Eigen::MatrixXd columns(stream.size(), 2);
  for (Eigen::Index k = 0; k < stream.size(); ++k) {
    const double t = stream.grid().t_s[static_cast<std::size_t>(k)] - track.t0_s;
    const double angle = 2 * std::numbers::pi * f_hz * t;
    columns(k, 0) = std::cos(angle);
    columns(k, 1) = std::sin(angle);
  }
  return columns;
}

/// Power of the chamber's rate of change at f over its neighbourhood.
double cycling_prominence(const Track& track, double f_hz) {
  const double span_s = track.step_s * static_cast<double>(track.record.size());
  const auto power = [&](double f) {
    double c = 0, s = 0;
    for (const rig::Drivers& now : track.record) {
      const double rate = std::clamp(now.chamber_rate_c_per_min, -0.3, 0.3);
      const double angle = 2 * std::numbers::pi * f * now.t_s;
      c += rate * std::cos(angle);
      s += rate * std::sin(angle);
    }
    return c * c + s * s;
  };
  double around = 0;
  constexpr int neighbours = 6;
  for (int k = 1; k <= neighbours; ++k) {
    const double away = (8.0 + 3.0 * k) / span_s;
    around += (power(f_hz + away) + power(std::max(f_hz - away, 0.5 / span_s))) / (2 * neighbours);
  }
  double here = 0;
  for (int k = -3; k <= 3; ++k) here = std::max(here, power(f_hz + 0.5 * k / span_s));
  return here / std::max(around, 1e-300);
}

struct Peak {
  double f_hz = 0, nats = 0;
};

/// Gain of a free sine at each frequency, noise fixed.
std::vector<Peak> scan(const SlowModel& model, const SlowNoiseShape& noise) {
  const SlowStream& stream = model.stream();
  const OffDesign design(model, noise);
  const Eigen::VectorXd y = design.off(model.y());
  const double rss = y.squaredNorm();
  const auto n = static_cast<double>(y.size());
  const double span_s = stream.grid().t_s.back() - stream.grid().t_s.front();
  const double f_max = 0.45 * n / span_s;
  std::vector<Peak> peaks;
  constexpr Eigen::Index block = 64;
  const auto count = static_cast<Eigen::Index>((f_max * span_s - turns_min) * 2);
  for (Eigen::Index first = 0; first < count; first += block) {
    const Eigen::Index size = std::min(block, count - first);
    Eigen::MatrixXd columns(y.size(), 2 * size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double f = (turns_min + 0.5 * static_cast<double>(first + i)) / span_s;
      columns.middleCols(2 * i, 2) = columns_at(stream, model.track(), f);
    }
    const Eigen::MatrixXd x = design.off(columns);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto pair = x.middleCols(2 * i, 2);
      const Eigen::Matrix2d gram = pair.transpose() * pair;
      const Eigen::Vector2d along = pair.transpose() * y;
      const double determinant = gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(0, 1);
      if (determinant <= 1e-9 * gram(0, 0) * gram(1, 1)) continue;
      const double explained =
          (gram(1, 1) * along(0) * along(0) - 2 * gram(0, 1) * along(0) * along(1) +
           gram(0, 0) * along(1) * along(1)) /
          determinant;
      peaks.push_back({(turns_min + 0.5 * static_cast<double>(first + i)) / span_s,
                       -0.5 * n * std::log1p(-std::min(explained / rss, 1 - 1e-12))});
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.nats > b.nats; });
  return peaks;
}

Eigen::MatrixXd with_line(const SlowModel& model, double f_hz) {
  Eigen::MatrixXd design(model.y().size(), model.design().cols() + 2);
  design << model.design(), columns_at(model.stream(), model.track(), f_hz);
  return design;
}

}  // namespace

std::optional<SlowLine> find_slow_line(const SlowModel& model) {
  const SlowGrid& grid = model.stream().grid();
  if (grid.t_s.size() < 64) return std::nullopt;
  const double span_s = grid.t_s.back() - grid.t_s.front();
  const double places = std::log(static_cast<double>(grid.t_s.size()));
  std::optional<SlowLine> best;
  for (const SlowNoiseShape& noise : {model.fit_free().shape, model.fit().shape}) {
    int tried = 0;
    for (const Peak& peak : scan(model, noise)) {
      if (peak.nats < line_worth_refining_nats || tried == 3) break;
      if (cycling_prominence(model.track(), peak.f_hz) > cycling_over_neighbours) continue;
      ++tried;
      const SlowWhitener whitener(grid, noise);
      const auto cost = [&](const Eigen::VectorXd& x) {
        const double f = peak.f_hz + std::clamp(x(0), -1.0, 1.0) / span_s;
        return -fit_whitened(whitener, noise, model.y(), with_line(model, f)).log_likelihood;
      };
      const auto found =
          minimise(cost, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 0.3), 0.01, 40);
      const double f = peak.f_hz + std::clamp(found.at(0), -1.0, 1.0) / span_s;
      const Eigen::MatrixXd design = with_line(model, f);
      const SlowFit fit = refit_noise(grid, model.y(), design, all_noise, noise);
      const SlowFit same = refit_noise(grid, model.y(), design, model.noise(), model.fit().shape);
      SlowLine line;
      line.f_hz = f;
      line.nats = std::max(fit.log_likelihood, same.log_likelihood) -
                  model.fit_free().log_likelihood - places;
      line.nats_same_noise = same.log_likelihood - model.fit().log_likelihood - places;
      if (best && line.nats <= best->nats) continue;
      line.amplitude_dps = fit.coefficients.tail(2).norm();
      line.amplitude_sd_dps = fit.standard_error.tail(2).norm() / std::numbers::sqrt2;
      line.courses = {course_of(model.track(), f, 0.0), course_of(model.track(), f, 0.25)};
      best = std::move(line);
    }
  }
  return best;
}

}  // namespace gyrocal
