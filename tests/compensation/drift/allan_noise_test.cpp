#include "compensation/drift/allan_noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/compensation/drift/noise_series.h"

using namespace gyrocal;
using namespace gyrocal::test;

TEST_CASE("white noise is angle random walk and nothing else", "[allan]") {
  std::mt19937 random(1);
  const AllanNoise noise = fit_allan_noise(white(3000, 1.31, random), 50).value();
  const double expected = 1.31 / std::sqrt(50.0);
  CHECK(noise.angle_random_walk.resolved);
  CHECK(std::abs(noise.angle_random_walk.value / expected - 1) < 0.05);
  CHECK(noise.angle_random_walk.low < expected);
  CHECK(noise.angle_random_walk.high > expected);
  CHECK_FALSE(noise.bias_instability.resolved);
  CHECK(noise.bias_instability.value == 0);
  CHECK(noise.bias_instability.high > 0);
  CHECK(noise.bias_instability.high < 0.2);
  CHECK_FALSE(noise.rate_random_walk.resolved);
  CHECK_FALSE(noise.correlated.resolved);
  CHECK(noise.fitted_from == 1);
  CHECK(noise.described);
  // the sum is the white part alone
  CHECK(std::abs(noise.variance_at(60) * 60 / std::pow(noise.angle_random_walk.value, 2) - 1) <
        1e-9);
}

TEST_CASE("the 95 % interval of the angle random walk holds the truth in about 95 % of dwells",
          "[allan][property]") {
  std::mt19937 random(2);
  int held = 0;
  for (int dwell = 0; dwell < 100; ++dwell) {
    const auto walk = fit_allan_noise(white(1000, 1, random), 1).value().angle_random_walk;
    held += walk.low <= 1 && 1 <= walk.high;
  }
  CHECK(held >= 90);
}

TEST_CASE("flicker is bias instability, and its floor is 0.664 of it", "[allan]") {
  std::mt19937 random(3);
  std::vector<double> rate = flicker(20000, random);
  const std::vector<double> fast = white(rate.size(), 10, random);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] += fast[i];
  const AllanNoise noise = fit_allan_noise(rate, 50).value();
  const double expected = std::sqrt(std::numbers::pi / std::numbers::ln2);  // floor sqrt(2)
  CHECK(noise.bias_instability.resolved);
  CHECK(noise.bias_instability.low < expected);
  CHECK(noise.bias_instability.high > expected);
  CHECK(std::abs(noise.angle_random_walk.value * std::sqrt(50.0) / 10 - 1) < 0.05);
}

TEST_CASE("a random walk is rate random walk", "[allan]") {
  std::mt19937 random(4);
  std::vector<double> rate = white(5000, 0.01, random);
  for (std::size_t i = 1; i < rate.size(); ++i) rate[i] += rate[i - 1];
  const AllanNoise noise = fit_allan_noise(rate, 50).value();
  CHECK(noise.rate_random_walk.resolved);
  CHECK(std::abs(noise.rate_random_walk.value / (0.01 * std::sqrt(50.0)) - 1) < 0.1);
}

TEST_CASE("noise with a memory of 10 samples is found with its memory", "[allan]") {
  std::mt19937 random(5);
  const double memory = std::exp(-0.1);
  const AllanNoise noise = fit_allan_noise(autoregressive(6000, memory, random), 50).value();
  CHECK(noise.correlated.resolved);
  CHECK(std::abs(noise.correlation_time_s / 0.2 - 1) < 0.2);
  CHECK(std::abs(noise.correlated.value * std::sqrt(1 - memory * memory) - 1) < 0.1);
}

TEST_CASE("a constant series has no noise, an alternating one no crash", "[allan]") {
  const AllanNoise none = fit_allan_noise(std::vector<double>(100, 4.2), 50).value();
  CHECK(none.angle_random_walk.value == 0);
  CHECK(none.variance_at(2) == 0);
  std::vector<double> alternating;
  for (int i = 0; i < 256; ++i) alternating.push_back(i % 2);
  CHECK(std::isfinite(fit_allan_noise(alternating, 50).value().variance_at(5)));
}

TEST_CASE("31 samples are too few for a noise", "[allan]") {
  CHECK(fit_allan_noise(std::vector<double>(31, 1.0), 50).error().code == Errc::too_few_points);
  CHECK(fit_allan_noise(std::vector<double>(32, 1.0), -1).error().code == Errc::out_of_range);
}
