#include "daemon/campaign/safety.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace gyrocal::campaign {

SCENARIO("a lone 0.0 and a jump over 20 K are doubted, five in a row believed") {
  ReadingFilter filter;
  REQUIRE(filter.pass(Celsius{45}));
  CHECK_FALSE(filter.pass(Celsius{0.0}));
  CHECK(filter.pass(Celsius{45.1}));
  for (int i = 0; i < 4; ++i) CHECK_FALSE(filter.pass(Celsius{70}));
  CHECK(filter.pass(Celsius{70}) == Celsius{70});
  CHECK(filter.doubtful() == 6);
}

SCENARIO("a chamber passing through zero is believed") {
  ReadingFilter filter;
  REQUIRE(filter.pass(Celsius{0.3}));
  CHECK(filter.pass(Celsius{0.0}));
  CHECK(filter.pass(Celsius{-0.2}));
}

SCENARIO("a reading that is no number is never believed") {
  ReadingFilter filter;
  REQUIRE(filter.pass(Celsius{20}));
  for (int i = 0; i < 20; ++i) CHECK_FALSE(filter.pass(Celsius{std::nan("")}));
}

SCENARIO("a first reading of exactly zero is doubted until it is repeated") {
  ReadingFilter filter;
  for (int i = 0; i < 4; ++i) CHECK_FALSE(filter.pass(Celsius{0.0}));
  CHECK(filter.pass(Celsius{0.0}));
}

}  // namespace gyrocal::campaign
