#include "compensation/discrepancy/relaxing_drift.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/profiled_level.h"
#include "compensation/discrepancy/simplex.h"

namespace gyrocal {
namespace {

struct Relaxing {
  double variance = 0;  // over the white variance of one second
  double tau_s = 0;
};

/// White level and coefficients profiled out.  @param columns  design and, last, y.
double log_likelihood(const SlowGrid& grid, const Eigen::MatrixXd& columns,
                      const Relaxing& relaxing) {
  const Eigen::Index n = columns.rows(), width = columns.cols();
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(width);
  Eigen::MatrixXd white(n, width);
  double variance = relaxing.variance, logs = 0, dt_known_s = -1, keep = 1;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k > 0) {
      const double dt_s = grid.t_s[at] - grid.t_s[at - 1];
      if (dt_s != dt_known_s) keep = std::exp(-dt_s / relaxing.tau_s), dt_known_s = dt_s;
      state *= keep;
      variance = relaxing.variance + keep * keep * (variance - relaxing.variance);
    }
    const double innovation = variance + 1 / grid.weight_s[at];
    const Eigen::RowVectorXd error = columns.row(k) - state;
    white.row(k) = error / std::sqrt(innovation);
    state += variance / innovation * error;
    variance -= variance * variance / innovation;
    logs += std::log(innovation);
  }
  return profile_level(white, logs).log_likelihood;
}

}  // namespace

double relaxing_log_likelihood(const SlowGrid& grid, const Eigen::VectorXd& y,
                               const Eigen::MatrixXd& design) {
  Eigen::MatrixXd columns(y.size(), design.cols() + 1);
  columns << design, y;
  const auto cost = [&](const Eigen::VectorXd& x) {
    return -log_likelihood(grid, columns,
                           {std::exp(std::clamp(x(0), -16.0, 16.0)), std::exp(x(1))});
  };
  double best = -1e300;
  for (const double tau_s : {40.0, 1000.0}) {
    const SimplexResult found =
        minimise(cost, Eigen::Vector2d(std::log(0.3 / grid.weight_s.front()), std::log(tau_s)),
                 Eigen::Vector2d(1.5, 1.0), 0.02, 60);
    best = std::max(best, -found.value);
  }
  return best;
}

}  // namespace gyrocal
