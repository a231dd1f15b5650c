#include "compensation/values/log_gamma.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace gyrocal;

TEST_CASE("log_gamma is the factorial's logarithm and Gauss' at a half", "[numerics]") {
  double sum = 0;
  for (int n = 1; n < 40; ++n) {
    CHECK(log_gamma(n) == Approx(sum).margin(1e-12));
    sum += std::log(n);
  }
  CHECK(log_gamma(0.5) == Approx(0.5 * std::log(std::numbers::pi)));
  CHECK(log_gamma(1e6) == Approx(12815504.569147611).epsilon(1e-14));  // by Python
}
