#include "tests/hidden_effects/noise.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace {

/// One-sided power density at a frequency, averaged over non-overlapping Hann windows. A direct
/// sum, so that it shares nothing with the synthesis under test.
double density_at(const std::vector<double>& series, double cycles_per_sample, std::size_t window) {
  double sum = 0.0;
  std::size_t windows = 0;
  for (std::size_t start = 0; start + window <= series.size(); start += window, ++windows) {
    double re = 0.0, im = 0.0, power = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < window; ++i)
      mean += series[start + i] / static_cast<double>(window);
    for (std::size_t i = 0; i < window; ++i) {
      const double angle = hidden::full_turn * static_cast<double>(i);
      const double hann = 0.5 - 0.5 * std::cos(angle / static_cast<double>(window));
      re += hann * (series[start + i] - mean) * std::cos(angle * cycles_per_sample);
      im += hann * (series[start + i] - mean) * std::sin(angle * cycles_per_sample);
      power += hann * hann;
    }
    sum += 2.0 * (re * re + im * im) / power;
  }
  return sum / static_cast<double>(windows);
}

}  // namespace

TEST_CASE("flicker has the density B^2/(2 pi f) over three decades") {
  const double b = 0.003;
  hidden::Random random(11);
  const auto noise = hidden::flicker_noise(1 << 18, b, random);
  for (double hz : {0.0005, 0.005, 0.05}) {
    // As many cycles a window at each frequency, so as many windows as there are.
    const auto window = static_cast<std::size_t>(12.0 / hz);
    INFO(hz << " Hz");
    double averaged = 0.0;  // neighbouring bins, to scatter less
    for (int k = -3; k <= 3; ++k) {
      const double at = hz * (1.0 + k / 12.0);
      averaged += density_at(noise, at, window) / (b * b / (hidden::full_turn * at)) / 7.0;
    }
    CHECK(averaged == Approx(1.0).margin(0.25));
  }
}

TEST_CASE("flicker of nothing is nothing, and the same seed gives the same noise") {
  hidden::Random one(5);
  hidden::Random two(5);
  CHECK(hidden::flicker_noise(100, 0.0, one) == std::vector<double>(100, 0.0));
  hidden::Random again(5);
  CHECK(hidden::flicker_noise(1000, 0.1, two) == hidden::flicker_noise(1000, 0.1, again));
}

TEST_CASE("a random walk's variance grows as K^2 t") {
  const double k = 2e-4;
  hidden::Random random(3);
  double square = 0.0;
  constexpr int walks = 2000;
  for (int w = 0; w < walks; ++w) {
    const auto walk = hidden::random_walk(401, k, 0.5, random);
    REQUIRE(walk.front() == 0.0);
    square += walk.back() * walk.back() / walks;
  }
  CHECK(square == Approx(k * k * 200.0).epsilon(0.12));  // three standard errors
}
