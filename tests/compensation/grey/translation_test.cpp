#include "compensation/grey/translation.h"

#include <catch2/catch.hpp>
#include <random>

using namespace gyrocal;

TEST_CASE("a positive series is left alone", "[grey]") {
  CHECK(translation_for(Eigen::Vector4d(4.3, 4.2, 0.001, 4.1)) == 0);
}

TEST_CASE("a translated series is positive and passes the class-ratio check", "[grey][property]") {
  const auto seed = GENERATE(range(0u, 50u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> value(-1, 2);
  Eigen::VectorXd drift(5 + seed);
  for (double& x : drift) x = value(random);
  drift(0) = -std::abs(drift(0));
  const double translation = translation_for(drift);
  const Eigen::VectorXd moved = drift.array() + translation;
  CHECK(translation > 0);
  CHECK(moved.minCoeff() > 0);
  CHECK(class_ratios(moved).outside.empty());
}

TEST_CASE("constant series of zero and below become positive", "[grey]") {
  CHECK(translation_for(Eigen::VectorXd::Zero(5)) == 1);
  CHECK(translation_for(Eigen::VectorXd::Constant(5, -3)) == 4);
}

TEST_CASE("the class ratios that leave the band are named", "[grey]") {
  const auto ratios = class_ratios(Eigen::Vector4d(1, 1.2, 3, 3.1));
  CHECK(ratios.high == Approx(std::exp(0.4)));
  CHECK(ratios.low == Approx(std::exp(-0.4)));
  CHECK(ratios.outside == std::vector<std::size_t>{2});
  CHECK(ratios.ratio[1] == Approx(0.4));
}

TEST_CASE("no values need no translation", "[grey][bad input]") {
  CHECK(translation_for(Eigen::VectorXd(0)) == 0);
}
