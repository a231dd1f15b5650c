#include "compensation/rig/random.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace gyrocal::rig;

TEST_CASE("the random stream gives the same numbers on every machine") {
  RandomStream random({1, 2, 3, 4});
  CHECK(random.bits() == 2265814340535190116u);
  CHECK(random.normal() == -0x1.dd1f2cbdf7ebap-5);
}

TEST_CASE("streams of different keys share nothing") {
  const StreamKey base{7, 0, 0, 0};
  for (const StreamKey other : {StreamKey{8, 0, 0, 0}, StreamKey{7, 1, 0, 0}, StreamKey{7, 0, 1, 0},
                                StreamKey{7, 0, 0, 1}}) {
    RandomStream a(base);
    RandomStream b(other);
    double product = 0.0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) product += a.normal() * b.normal();
    CHECK(std::abs(product / n) < 5.0 / std::sqrt(n));
  }
}

TEST_CASE("normal deviates have the moments and tails of the normal law") {
  RandomStream random({11, 0, 0, 0});
  constexpr int n = 4'000'000;
  double sum = 0, square = 0, cube = 0, fourth = 0;
  int beyond_2 = 0, beyond_3 = 0, beyond_edge = 0;  // the edge of the base layer is 3.654
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    square += x * x;
    cube += x * x * x;
    fourth += x * x * x * x;
    beyond_2 += std::abs(x) > 2.0;
    beyond_3 += std::abs(x) > 3.0;
    beyond_edge += std::abs(x) > 3.7;
  }
  const double root_n = std::sqrt(n);
  CHECK(std::abs(sum / n) < 5.0 / root_n);
  CHECK(std::abs(square / n - 1.0) < 5.0 * std::sqrt(2.0) / root_n);
  CHECK(std::abs(cube / n) < 5.0 * std::sqrt(15.0) / root_n);
  CHECK(std::abs(fourth / n - 3.0) < 5.0 * std::sqrt(96.0) / root_n);
  const auto agrees = [&](int count, double x) {
    const double p = std::erfc(x / std::sqrt(2.0));
    return std::abs(count - n * p) < 5.0 * std::sqrt(n * p);
  };
  CHECK(agrees(beyond_2, 2.0));
  CHECK(agrees(beyond_3, 3.0));
  CHECK(agrees(beyond_edge, 3.7));
}
