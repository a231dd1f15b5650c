#include "compensation/drift/index_axis.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

TEST_CASE("an uneven setpoint list maps to whole indices and back", "[drift]") {
  const auto axis = index_axis({-10, -7, -5, -2, 0, 3});
  REQUIRE(axis.has_value());
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(index_at(*axis, {axis->setpoints_c[i]}) == static_cast<double>(i + 1));
    CHECK(temperature_at(*axis, static_cast<double>(i + 1)).value == axis->setpoints_c[i]);
  }
  CHECK(index_at(*axis, {-8.5}) == Approx(1.5));
  CHECK(index_at(*axis, {-6}) == Approx(2.5));
  CHECK(temperature_at(*axis, 5.5).value == Approx(1.5));
}

TEST_CASE("outside the list the end steps go on", "[drift]") {
  const auto axis = index_axis({0, 2, 5});
  REQUIRE(axis.has_value());
  CHECK(index_at(*axis, {-2}) == Approx(0));
  CHECK(index_at(*axis, {8}) == Approx(4));
  CHECK(temperature_at(*axis, 0).value == Approx(-2));
  CHECK(temperature_at(*axis, 4).value == Approx(8));
  CHECK(covers(*axis, {0}));
  CHECK(covers(*axis, {5}));
  CHECK_FALSE(covers(*axis, {5.0001}));
}

TEST_CASE("axes that do not rise are refused", "[drift][bad input]") {
  CHECK(index_axis({}).error().code == Errc::too_few_points);
  CHECK(index_axis({20}).error().code == Errc::too_few_points);
  CHECK(index_axis({20, 20}).error().code == Errc::out_of_range);
  CHECK(index_axis({20, 10}).error().code == Errc::out_of_range);
  CHECK(index_axis({20, std::nan("")}).error().code == Errc::not_finite);
}
