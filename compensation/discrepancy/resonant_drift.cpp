#include "compensation/discrepancy/resonant_drift.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compensation/discrepancy/profiled_level.h"
#include "compensation/discrepancy/simplex.h"

namespace gyrocal {
namespace {

struct Resonance {
  double variance = 0;  // of x over the white variance of one second
  double w0_per_s = 0, quality = 0;
};

/// exp(A dt) of the free resonance, A + a I by its sine or its hyperbolic sine.
Eigen::Matrix2d move(const Resonance& resonance, double dt_s) {
  const double w0 = resonance.w0_per_s, a = w0 / (2 * resonance.quality);
  Eigen::Matrix2d off;
  off << a, 1, -w0 * w0, -a;
  const double s2 = a * a - w0 * w0;
  const double s = std::sqrt(std::abs(s2));
  const double turn = s * dt_s, damp = a * dt_s;
  if (turn < 1e-6) return std::exp(-damp) * (Eigen::Matrix2d::Identity() + dt_s * off);
  if (s2 < 0) {
    return std::exp(-damp) *
           (std::cos(turn) * Eigen::Matrix2d::Identity() + std::sin(turn) / s * off);
  }
  const double slow = std::exp(turn - damp), fast = std::exp(-turn - damp);
  return (slow + fast) / 2 * Eigen::Matrix2d::Identity() + (slow - fast) / (2 * s) * off;
}

/// @param columns  design and, last, y.
ProfiledLevel profile(const SlowGrid& grid, const Eigen::MatrixXd& columns,
                      const Resonance& resonance) {
  const Eigen::Index n = columns.rows(), width = columns.cols();
  const double v = resonance.variance;
  const Eigen::Matrix2d still =
      Eigen::Vector2d(v, v * resonance.w0_per_s * resonance.w0_per_s).asDiagonal();
  Eigen::Matrix2d covariance = still, phi = Eigen::Matrix2d::Identity();
  Eigen::Matrix<double, 2, Eigen::Dynamic> state(2, width);
  state.setZero();
  Eigen::MatrixXd white(n, width);
  double logs = 0, dt_known_s = -1;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k > 0) {
      const double dt_s = grid.t_s[at] - grid.t_s[at - 1];
      if (std::abs(dt_s - dt_known_s) > 1e-9) phi = move(resonance, dt_s), dt_known_s = dt_s;
      state = (phi * state).eval();
      covariance = still + phi * (covariance - still) * phi.transpose();
    }
    const double innovation = covariance(0, 0) + 1 / grid.weight_s[at];
    const Eigen::Vector2d gain = covariance.col(0) / innovation;
    const double scale = 1 / std::sqrt(innovation);
    for (Eigen::Index c = 0; c < width; ++c) {
      const double error = columns(k, c) - state(0, c);
      white(k, c) = error * scale;
      state(0, c) += gain(0) * error;
      state(1, c) += gain(1) * error;
    }
    covariance -= gain * gain.transpose() * innovation;
    logs += std::log(innovation);
  }
  return profile_level(white, logs);
}

}  // namespace

ResonantDrift fit_resonant_drift(const SlowModel& model) {
  const SlowGrid& grid = model.stream().grid();
  Eigen::MatrixXd columns(model.y().size(), model.design().cols() + 1);
  columns << model.design(), model.y();
  const double span_s = grid.t_s.back() - grid.t_s.front();
  // A trend over the whole record has no scale of its own.
  const double longest_s = span_s / 3;
  const double shortest_s = 4 * span_s / static_cast<double>(grid.t_s.size());
  const auto at = [&](const Eigen::VectorXd& x) {
    const double period_s = std::clamp(std::exp(x(1)), shortest_s, longest_s);
    return Resonance{std::exp(std::clamp(x(0), -16.0, 8.0)), 2 * std::numbers::pi / period_s,
                     std::exp(std::clamp(x(2), -3.0, 4.0))};
  };
  const auto cost = [&](const Eigen::VectorXd& x) {
    return -profile(grid, columns, at(x)).log_likelihood;
  };
  // White noise of one second is this many times that of the whole misfit's share.
  const double start = std::log(0.5 * static_cast<double>(grid.t_s.size()) / span_s);
  ResonantDrift best;
  for (const double period_s : {900.0, 3000.0, 10000.0}) {
    for (const double log_quality : {-0.7, 1.5}) {
      const SimplexResult found =
          minimise(cost, Eigen::Vector3d(start, std::log(period_s), log_quality),
                   Eigen::Vector3d(1.5, 0.5, 0.7), 0.02, 90);
      if (-found.value <= best.log_likelihood) continue;
      const Resonance resonance = at(found.at);
      best.log_likelihood = -found.value;
      best.period_s = 2 * std::numbers::pi / resonance.w0_per_s;
      best.quality = resonance.quality;
      best.turns = std::max(1.0, span_s / best.period_s);
      best.sd_dps =
          std::sqrt(resonance.variance * profile(grid, columns, resonance).white_variance);
    }
  }
  return best;
}

}  // namespace gyrocal
