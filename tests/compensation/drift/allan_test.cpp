#include "compensation/drift/allan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "compensation/drift/allan_confidence.h"

using namespace gyrocal;

namespace {

double deviation(const std::vector<double>& rate, std::size_t averaged) {
  const std::vector<std::size_t> factors{averaged};
  return overlapping_allan(rate, 1.0, factors).value().at(0).deviation;
}

}  // namespace

TEST_CASE("overlapping Allan deviations of NIST SP 1065's nine frequencies", "[allan][golden]") {
  const std::vector<double> rate{892, 809, 823, 798, 671, 644, 883, 903, 677};
  CHECK(std::abs(deviation(rate, 1) - 91.22945) < 5e-6);
  CHECK(std::abs(deviation(rate, 2) - 85.95287) < 5e-6);
}

TEST_CASE("overlapping Allan deviations of NIST SP 1065's thousand frequencies",
          "[allan][golden]") {
  std::vector<double> rate;
  for (std::int64_t n = 1234567890; rate.size() < 1000; n = 16807 * n % 2147483647) {
    rate.push_back(static_cast<double>(n) / 2147483647.0);
  }
  CHECK(std::abs(deviation(rate, 1) - 2.922319e-1) < 5e-8);
  CHECK(std::abs(deviation(rate, 10) - 9.159953e-2) < 5e-9);
  CHECK(std::abs(deviation(rate, 100) - 3.241343e-2) < 5e-9);
}

TEST_CASE("a ramp's deviation is its rise over one averaging time by the square root of 2",
          "[allan]") {
  std::vector<double> rate;
  for (int i = 0; i < 100; ++i) rate.push_back(1000 + 0.5 * i);
  CHECK(std::abs(deviation(rate, 8) - 0.5 * 8 / std::sqrt(2.0)) < 1e-12);
  CHECK(deviation(std::vector<double>(100, 4.2), 8) == 0);
}

TEST_CASE("averaging factors rise to half the samples", "[allan]") {
  CHECK(allan_factors(50, 4) == std::vector<std::size_t>{1, 2, 3, 6, 10, 18});
  CHECK(allan_factors(1, 4).empty());
}

TEST_CASE("degrees of freedom of white noise approach n - 1 over 1.5 at m = 1 and 1 at n/2",
          "[allan]") {
  CHECK(std::abs(allan_degrees_of_freedom(3000, 1, RateNoise::white) - 1999.11) < 0.01);
  CHECK(std::abs(allan_degrees_of_freedom(3000, 1500, RateNoise::white) - 1.0) < 0.01);
  CHECK(noise_of_slope(-1.0) == RateNoise::white);
  CHECK(noise_of_slope(0.1) == RateNoise::flicker);
  CHECK(noise_of_slope(0.9) == RateNoise::random_walk);
}

TEST_CASE("chi-squared quantiles as tabulated", "[allan]") {
  CHECK(std::abs(chi_squared_quantile(1, 0.95) - 3.841458821) < 1e-8);
  CHECK(std::abs(chi_squared_quantile(10, 0.025) - 3.246972780) < 1e-8);
  CHECK(std::abs(chi_squared_quantile(2, 0.5) - 2 * std::log(2.0)) < 1e-12);
  CHECK(std::abs(chi_squared_quantile(100, 0.975) - 129.5611972) < 1e-6);
}

TEST_CASE("the 95 % interval of two samples is wide and lopsided", "[allan]") {
  const std::vector<double> rate{0, 1};
  const std::vector<std::size_t> factors{1};
  const AllanPoint point = overlapping_allan(rate, 50.0, factors).value().at(0);
  CHECK(point.tau_s == 0.02);
  CHECK(std::abs(point.deviation - std::sqrt(0.5)) < 1e-15);
  CHECK(std::abs(point.degrees_of_freedom - 28.0 / 27.0) < 1e-12);
  CHECK(std::abs(point.deviation_low / point.deviation - 0.4499) < 1e-3);
  CHECK(std::abs(point.deviation_high / point.deviation - 28.34) < 0.01);
}

TEST_CASE("pieces are pooled term by term, each with its own mean", "[allan]") {
  const std::vector<double> first{1, 2, 4};
  const std::vector<double> second{1000, 1003};
  const std::vector<std::span<const double>> pieces{first, second};
  const std::vector<std::size_t> factors{1};
  const auto points = overlapping_allan(pieces, 1.0, factors).value();
  // differences 1, 2 and 3
  CHECK(std::abs(points.at(0).deviation - std::sqrt((1.0 + 4.0 + 9.0) / (2 * 3))) < 1e-12);
  CHECK(longest_of(pieces) == 3);
}

TEST_CASE("bad input is named", "[allan]") {
  const std::vector<std::size_t> one{1};
  const std::vector<std::size_t> three{3};
  const std::vector<double> rate{1, 2, 3, 4};
  CHECK(overlapping_allan(std::vector<double>{1}, 50, one).error().code == Errc::too_few_points);
  CHECK(overlapping_allan(rate, 0, one).error().code == Errc::out_of_range);
  CHECK(overlapping_allan(rate, 50, three).error() ==
        Error{Errc::out_of_range, "averaging factor 3", "expected 1 to 2"});
  const std::vector<double> lost{1, std::numeric_limits<double>::quiet_NaN(), 3};
  CHECK(overlapping_allan(lost, 50, one).error().what == "sample 1 of 3 is nan");
}
