#include "compensation/rig/portable_math.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gyrocal::rig;

TEST_CASE("portable exp, log and sine agree with the C library to the last places") {
  for (double x = -700.0; x <= 700.0; x += 0.731) {
    CAPTURE(x);
    CHECK(portable_exp(x) == Approx(std::exp(x)).epsilon(4e-16));
  }
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    CAPTURE(x);
    CHECK(std::abs(portable_log(x) - std::log(x)) <= 4e-16 * std::max(1.0, std::abs(std::log(x))));
  }
  for (double turns = -5.0; turns <= 5.0; turns += 0.00917) {
    CAPTURE(turns);
    const double expected = std::sin(2.0 * 3.14159265358979323846 * (turns - std::floor(turns)));
    CHECK(std::abs(portable_sine(turns) - expected) < 3e-15);  // 2 pi turns itself is rounded
  }
}

TEST_CASE("portable sine is exact where it must be") {
  CHECK(portable_sine(0.0) == 0.0);
  CHECK(portable_sine(0.25) == Approx(1.0).epsilon(1e-15));
  CHECK(portable_sine(-0.25) == Approx(-1.0).epsilon(1e-15));
  CHECK(std::abs(portable_sine(0.5)) < 1e-15);
  CHECK(portable_exp(0.0) == 1.0);
  CHECK(portable_log(1.0) == 0.0);
}
