#include "compensation/drift/mean_error.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/compensation/drift/noise_series.h"

using namespace gyrocal;
using namespace gyrocal::test;

namespace {

constexpr std::size_t dwell_samples = 3000;

/// Median over 40 dwells of the standard error found, relative to the true one.
template <class Series>
double median_ratio(Series series, double truth) {
  std::mt19937 random(20260102);
  std::vector<double> ratios;
  for (int dwell = 0; dwell < 40; ++dwell) {
    ratios.push_back(standard_error_of_mean(series(random), 50).value() / truth);
  }
  return median(ratios);
}

}  // namespace

TEST_CASE("the mean of white noise is as sure as sigma over the root of n", "[allan]") {
  const double ratio = median_ratio([](auto& random) { return white(dwell_samples, 1.31, random); },
                                    1.31 / std::sqrt(static_cast<double>(dwell_samples)));
  CHECK(std::abs(ratio - 1) < 0.05);
}

TEST_CASE("the mean of noise with a memory is less sure, by as much as its memory says",
          "[allan]") {
  for (const double memory : {0.5, 0.9, 0.98}) {
    CAPTURE(memory);
    const double truth = 1 / (1 - memory) / std::sqrt(static_cast<double>(dwell_samples));
    const double naive = truth * std::sqrt((1 - memory) / (1 + memory));
    const double ratio = median_ratio(
        [memory](auto& random) { return autoregressive(dwell_samples, memory, random); }, truth);
    CHECK(std::abs(ratio - 1) < 0.15);
    CHECK(naive < 0.6 * truth);  // what sigma/sqrt(n) would have claimed
  }
}

TEST_CASE("the mean of flicker noise is no surer than the floor of its Allan deviation",
          "[allan]") {
  const double ratio =
      median_ratio([](auto& random) { return flicker(dwell_samples, random); }, std::sqrt(2.0));
  CHECK(std::abs(ratio - 1) < 0.25);
}

TEST_CASE("the mean of a quantised dwell is as sure as that of the noise that dithers it",
          "[allan]") {
  const auto counts = [](std::mt19937& random) {
    std::vector<double> rate = white(dwell_samples, 1.31, random);
    for (double& x : rate) x = std::round((4.2 + x) * 4.13) / 4.13;
    return rate;
  };
  const double truth =
      std::sqrt((1.31 * 1.31 + 1 / (12 * 4.13 * 4.13)) / static_cast<double>(dwell_samples));
  CHECK(std::abs(median_ratio(counts, truth) - 1) < 0.05);
}

TEST_CASE("a constant dwell has no standard error, a short one is refused", "[allan]") {
  CHECK(standard_error_of_mean(std::vector<double>(100, 4.2), 50).value() == 0);
  CHECK(standard_error_of_mean(std::vector<double>(10, 4.2), 50).error().code ==
        Errc::too_few_points);
}
