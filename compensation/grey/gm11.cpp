#include "compensation/grey/gm11.h"

#include <fmt/core.h>

#include <Eigen/QR>
#include <cmath>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

constexpr Eigen::Index points_min = 4;

/// (1 - exp(-a s)) / a without cancellation; its limit s at a = 0.
double decayed_steps(double a, double s) { return a == 0 ? s : -std::expm1(-a * s) / a; }

Result<void> check_series(const Eigen::Ref<const Eigen::VectorXd>& index,
                          const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  const Eigen::Index n = drift_dps.size();
  if (n < points_min) {
    return fail(Errc::too_few_points,
                fmt::format("GM(1,1) needs at least {} zero drifts, got {}", points_min, n),
                "measure more setpoints");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(drift_dps(i)) || !std::isfinite(index(i))) {
      return fail(Errc::not_finite,
                  fmt::format("zero drift {} of {} is {}", i + 1, n, drift_dps(i)),
                  "repeat this dwell or leave it out");
    }
    if (drift_dps(i) < 0) {
      return fail(
          Errc::out_of_range,
          fmt::format("GM(1,1) needs a series >= 0 (Eq. 3); zero drift {} of {} is {} deg/s", i + 1,
                      n, drift_dps(i)),
          "translate the series first");
    }
  }
  return {};
}

}  // namespace

Eigen::VectorXd plain_index(Eigen::Index n) {
  return Eigen::VectorXd::LinSpaced(n, 1.0, static_cast<double>(n));
}

Eigen::VectorXd accumulated(const Eigen::Ref<const Eigen::VectorXd>& index,
                            const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  GYROCAL_ASSERT(index.size() == drift_dps.size());
  Eigen::VectorXd sum = drift_dps;
  for (Eigen::Index i = 1; i < sum.size(); ++i) {
    sum(i) = sum(i - 1) + (index(i) - index(i - 1)) * drift_dps(i);
  }
  return sum;
}

double accumulated_at(const Gm11& model, double k) {
  const double steps = k - model.first_index;
  return model.first_dps * std::exp(-model.a_per_step * steps) +
         model.b_dps * decayed_steps(model.a_per_step, steps);
}

double drift_at(const Gm11& model, double k) {
  const double second = model.first_index + 1;
  if (k >= second) return accumulated_at(model, k) - accumulated_at(model, k - 1);
  const double at_second = accumulated_at(model, second) - model.first_dps;
  return model.first_dps + (at_second - model.first_dps) * (k - model.first_index);
}

Result<Gm11> fit_gm11(const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  return fit_gm11(plain_index(drift_dps.size()), drift_dps);
}

Result<Gm11> fit_gm11(const Eigen::Ref<const Eigen::VectorXd>& index,
                      const Eigen::Ref<const Eigen::VectorXd>& drift_dps) {
  GYROCAL_ASSERT(index.size() == drift_dps.size());
  if (auto checked = check_series(index, drift_dps); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  const Eigen::Index n = drift_dps.size();
  const Eigen::VectorXd x1 = accumulated(index, drift_dps);
  Eigen::MatrixXd b_matrix(n - 1, 2);  // Eq. (7)
  b_matrix.col(0) = -0.5 * (x1.head(n - 1) + x1.tail(n - 1));
  b_matrix.col(1).setOnes();
  const Eigen::Vector2d solution = b_matrix.colPivHouseholderQr().solve(drift_dps.tail(n - 1));

  Gm11 model{solution(0), solution(1), index(0), drift_dps(0), Eigen::VectorXd(n)};
  if (!solution.allFinite()) {
    return fail(Errc::not_finite, "GM(1,1): the coefficients a and b are not finite",
                "are the zero drifts of a sensible size?");
  }
  for (Eigen::Index i = 0; i < n; ++i) model.fitted_dps(i) = drift_at(model, index(i));
  return model;
}

}  // namespace gyrocal
