#include "compensation/drift/smoothing_spline.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compensation/grey/polynomial.h"

using namespace gyrocal;

namespace {

struct Points {
  Eigen::VectorXd x, y, weights;
};

Points random_points(unsigned seed, Eigen::Index n) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(0.5, 4);
  std::normal_distribution<double> noise;
  Points p{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  double x = -10;
  for (Eigen::Index i = 0; i < n; ++i) {
    p.x(i) = x += step(random);
    p.y(i) = std::sin(x / 8) + 0.1 * noise(random);
    p.weights(i) = step(random);
  }
  return p;
}

double objective(const Points& p, const Spline& s, double lambda) {
  double roughness = 0;  // f'' is linear between knots: Simpson is exact for its square
  for (Eigen::Index i = 0; i + 1 < p.x.size(); ++i) {
    const double a = s.second(i);
    const double b = s.second(i + 1);
    roughness += (p.x(i + 1) - p.x(i)) * (a * a + a * b + b * b) / 3;
  }
  return (p.weights.array() * (p.y - s.values).array().square()).sum() + lambda * roughness;
}

}  // namespace

TEST_CASE("without roughness penalty the spline passes through every point", "[drift][property]") {
  const auto seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  const auto p = random_points(seed, 4 + static_cast<Eigen::Index>(seed));
  const auto spline = fit_smoothing_spline(p.x, p.y, p.weights, 0.0);
  REQUIRE(spline.has_value());
  CHECK(spline->trace == Approx(static_cast<double>(p.x.size())));
  for (Eigen::Index i = 0; i < p.x.size(); ++i) {
    CHECK(value_at(*spline, p.x(i)) == Approx(p.y(i)).margin(1e-12));
  }
}

TEST_CASE("under an endless penalty it is the weighted straight line", "[drift]") {
  const auto p = random_points(7, 25);
  const auto spline = fit_smoothing_spline(p.x, p.y, p.weights, 1e12);
  const auto line = fit_polynomial(p.x, p.y, 1, p.weights);
  REQUIRE(spline.has_value());
  REQUIRE(line.has_value());
  CHECK(spline->trace == Approx(2).epsilon(1e-4));
  for (const double x : {-20.0, 0.0, 13.0, 200.0}) {
    CHECK(value_at(*spline, x) == Approx(value_at(*line, x)).margin(1e-4));
  }
}

TEST_CASE("no neighbouring curve has a smaller penalised sum", "[drift][property]") {
  const auto seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  const auto p = random_points(seed, 15);
  const double lambda = std::pow(10.0, static_cast<double>(seed) / 4 - 2);
  const auto best = fit_smoothing_spline(p.x, p.y, p.weights, lambda);
  REQUIRE(best.has_value());
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  for (int i = 0; i < 20; ++i) {
    Points moved = p;
    for (double& value : moved.y) value = 1e-3 * noise(random);
    const auto shift = fit_smoothing_spline(moved.x, moved.y, moved.weights, 0.0);
    REQUIRE(shift.has_value());
    Spline other = *best;
    other.values += shift->values;
    other.second += shift->second;
    CHECK(objective(p, other, lambda) >= objective(p, *best, lambda));
  }
}

TEST_CASE("the trace is the sum of d value / d y", "[drift][property]") {
  const auto seed = GENERATE(range(0u, 10u));
  CAPTURE(seed);
  const auto p = random_points(seed, 12);
  const double lambda = std::pow(10.0, static_cast<double>(seed) / 2 - 1);
  const auto spline = fit_smoothing_spline(p.x, p.y, p.weights, lambda);
  REQUIRE(spline.has_value());
  double trace = 0;
  for (Eigen::Index i = 0; i < p.x.size(); ++i) {
    Eigen::VectorXd moved = p.y;
    moved(i) += 1;
    trace += fit_smoothing_spline(p.x, moved, p.weights, lambda)->values(i) - spline->values(i);
  }
  CHECK(spline->trace == Approx(trace).epsilon(1e-9));
}

TEST_CASE("a straight line stays a straight line whatever lambda is chosen", "[drift]") {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(12, 0, 55);
  const Eigen::VectorXd y = 4 - 0.01 * x.array();
  const auto spline = fit_smoothing_spline(x, y);
  REQUIRE(spline.has_value());
  CHECK((spline->values - y).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(value_at(*spline, 70) == Approx(3.3));
}

TEST_CASE("three points make no smoothing spline", "[drift][bad input]") {
  CHECK(fit_smoothing_spline(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 1, 0)).error().code ==
        Errc::too_few_points);
}
