#include "compensation/discrepancy/slow_smoother.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

const double log_half_decade = std::log(std::sqrt(10.0));

struct Moment {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

}  // namespace

DriftEstimate estimate_drift(const SlowGrid& grid, const SlowNoiseShape& shape, double white_sd_dps,
                             std::span<const RelaxingPart> parts,
                             const Eigen::VectorXd& residual_dps) {
  const auto n = static_cast<Eigen::Index>(grid.t_s.size());
  GYROCAL_ASSERT(residual_dps.size() == n);
  DriftEstimate estimate{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const double unit = white_sd_dps * white_sd_dps;
  std::vector<RelaxingPart> relaxing(parts.begin(), parts.end());
  if (shape.flicker_ratio > 0) {
    const double variance = shape.flicker_ratio * unit * log_half_decade / std::numbers::pi;
    for (const double tau_s : SlowWhitener::flicker_tau_s(grid)) {
      relaxing.push_back({tau_s, variance});
    }
  }
  const auto relaxers = static_cast<Eigen::Index>(relaxing.size());
  const Eigen::Index states = relaxers + (shape.walk_ratio > 0 ? 1 : 0);
  if (states == 0) return estimate;

  std::vector<Moment> ahead, now;  // before and after each bin's residual
  std::vector<Eigen::VectorXd> decays;
  Moment moment{Eigen::VectorXd::Zero(states), Eigen::MatrixXd::Zero(states, states)};
  for (Eigen::Index i = 0; i < relaxers; ++i) {
    moment.covariance(i, i) = relaxing[static_cast<std::size_t>(i)].variance_dps2;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    Eigen::VectorXd decay = Eigen::VectorXd::Ones(states);
    if (k > 0) {
      const double dt_s = grid.t_s[at] - grid.t_s[at - 1];
      Eigen::VectorXd fresh(states);
      for (Eigen::Index i = 0; i < relaxers; ++i) {
        const RelaxingPart& part = relaxing[static_cast<std::size_t>(i)];
        decay(i) = std::exp(-dt_s / part.tau_s);
        fresh(i) = part.variance_dps2 * (1 - decay(i) * decay(i));
      }
      if (states > relaxers) fresh(relaxers) = shape.walk_ratio * unit * dt_s;
      moment.mean = decay.asDiagonal() * moment.mean;
      moment.covariance = decay.asDiagonal() * moment.covariance * decay.asDiagonal();
      moment.covariance.diagonal() += fresh;
    }
    decays.push_back(decay);
    ahead.push_back(moment);
    if (grid.weight_s[at] > 0) {
      const Eigen::VectorXd seen = moment.covariance.rowwise().sum();
      const double innovation = seen.sum() + unit / grid.weight_s[at];
      moment.mean += seen * ((residual_dps(k) - moment.mean.sum()) / innovation);
      moment.covariance -= seen * seen.transpose() / innovation;
    }
    now.push_back(moment);
  }
  Moment after = now.back();
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    if (k + 1 < n) {
      const Eigen::MatrixXd cross = now[at].covariance * decays[at + 1].asDiagonal();
      const Eigen::MatrixXd gain =
          ahead[at + 1].covariance.ldlt().solve(cross.transpose()).transpose();
      Moment smooth = now[at];
      smooth.mean += gain * (after.mean - ahead[at + 1].mean);
      smooth.covariance += gain * (after.covariance - ahead[at + 1].covariance) * gain.transpose();
      after = std::move(smooth);
    }
    estimate.mean_dps(k) = after.mean.sum();
    estimate.variance_dps2(k) = std::max(after.covariance.sum(), 0.0);
  }
  return estimate;
}

}  // namespace gyrocal
