#include "compensation/discrepancy/slow_noise.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "compensation/discrepancy/slow_fit.h"

using namespace gyrocal;

namespace {

SlowGrid uneven_grid(int n) {
  SlowGrid grid;
  double t = 0;
  for (int i = 0; i < n; ++i) {
    t += i % 17 == 16 ? 140.0 : 20.0;  // a gap now and then
    grid.t_s.push_back(t);
    grid.weight_s.push_back(i % 5 == 0 ? 10.0 : 20.0);
  }
  return grid;
}

/// The covariance the state space stands for, written out whole.
Eigen::MatrixXd dense_covariance(const SlowGrid& grid, const SlowNoiseShape& shape) {
  const auto n = static_cast<Eigen::Index>(grid.t_s.size());
  Eigen::MatrixXd covariance(n, n);
  const double variance = shape.flicker_ratio * std::log(std::sqrt(10.0)) / std::numbers::pi;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double ti = grid.t_s[static_cast<std::size_t>(i)];
      const double tj = grid.t_s[static_cast<std::size_t>(j)];
      double value = shape.walk_ratio * (std::min(ti, tj) - grid.t_s.front());
      for (double tau : SlowWhitener::flicker_tau_s(grid)) {
        value += variance * std::exp(-std::abs(ti - tj) / tau);
      }
      if (i == j) value += 1.0 / grid.weight_s[static_cast<std::size_t>(i)];
      covariance(i, j) = value;
    }
  }
  return covariance;
}

Eigen::VectorXd white_noise(Eigen::Index n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

}  // namespace

TEST_CASE("the filter's likelihood is that of the dense covariance") {
  const SlowGrid grid = uneven_grid(120);
  const SlowNoiseShape shape{.flicker_ratio = 0.02, .walk_ratio = 1e-5};
  const Eigen::LLT<Eigen::MatrixXd> cholesky(dense_covariance(grid, shape));
  const Eigen::MatrixXd lower = cholesky.matrixL();
  const double log_determinant = 2 * lower.diagonal().array().log().sum();
  const Eigen::VectorXd y = white_noise(120, 3);
  const Eigen::VectorXd dense = lower.triangularView<Eigen::Lower>().solve(y);

  const SlowWhitener whitener(grid, shape);
  CHECK(whitener.log_determinant() == Approx(log_determinant).epsilon(1e-10));
  CHECK((whitener.whiten(y) - dense).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("the sum of the states is one over f between a bin and the campaign") {
  SlowGrid grid;
  for (int i = 0; i < 2000; ++i) {
    grid.t_s.push_back(20.0 * i);
    grid.weight_s.push_back(20.0);
  }
  const double step = std::log(std::sqrt(10.0));
  for (double f : {1e-4, 3e-4, 1e-3}) {
    double density = 0;  // two-sided, for B = 1
    for (double tau : SlowWhitener::flicker_tau_s(grid)) {
      const double w = 2 * std::numbers::pi * f * tau;
      density += step / std::numbers::pi * 2 * tau / (1 + w * w);
    }
    INFO("f = " << f);
    CHECK(density == Approx(1 / (2 * std::numbers::pi * f)).epsilon(0.08));
  }
}

TEST_CASE("noise of known levels is found again, and nothing where there is none") {
  SlowGrid grid;
  for (int i = 0; i < 2000; ++i) {
    grid.t_s.push_back(20.0 * i);
    grid.weight_s.push_back(20.0);
  }
  const Eigen::MatrixXd design = Eigen::MatrixXd::Ones(2000, 1);
  const auto seed = GENERATE(range(0u, 4u));
  CAPTURE(seed);
  const Eigen::VectorXd white = white_noise(2000, seed) * (0.014 / std::sqrt(20.0));

  SECTION("white only") {
    const SlowFit none = fit_noise(grid, white, design, {});
    const SlowFit free = fit_noise(grid, white, design, {.flicker = true, .walk = true});
    CHECK(none.white_sd_dps == Approx(0.014).epsilon(0.06));
    CHECK(free.log_likelihood - none.log_likelihood < 6);
    CHECK(free.log_likelihood >= none.log_likelihood);
  }
  SECTION("a random walk of 0.04 mdps per root second") {
    Eigen::VectorXd y = white;
    const Eigen::VectorXd kicks = white_noise(2000, seed + 100) * 4e-5 * std::sqrt(20.0);
    double level = 0;
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) += level += kicks(i);
    const SlowFit fit = fit_noise(grid, y, design, {.flicker = true, .walk = true});
    const SlowFit walk = fit_noise(grid, y, design, {.walk = true});
    CHECK(walk.white_sd_dps * std::sqrt(walk.shape.walk_ratio) == Approx(4e-5).epsilon(0.3));
    CHECK(fit.log_likelihood - walk.log_likelihood < 4);
    CHECK(fit.log_likelihood - fit_noise(grid, y, design, {}).log_likelihood > 50);
  }
}
