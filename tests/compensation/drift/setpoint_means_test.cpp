#include "compensation/drift/setpoint_means.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

TEST_CASE("a sweep up and down gives each setpoint once, in rising order", "[drift]") {
  const auto means = setpoint_means({{0, 10, 20, 10, 0}, {4.0, 4.2, 4.4, 4.3, 4.2}});
  REQUIRE(means.has_value());
  CHECK(means->table.temperature_c == std::vector<double>{0, 10, 20});
  CHECK(means->table.zero_drift_dps[0] == Approx(4.1));
  CHECK(means->table.zero_drift_dps[1] == Approx(4.25));
  CHECK(means->standard_error_dps.empty());
}

TEST_CASE("the better known dwell weighs more", "[drift]") {
  const auto means = setpoint_means({{0, 0}, {4.0, 5.0}}, {0.1, 0.2});
  REQUIRE(means.has_value());
  CHECK(means->table.zero_drift_dps[0] == Approx(4.2));
  CHECK(means->standard_error_dps[0] == Approx(0.2 / std::sqrt(5)));
}

TEST_CASE("dwells without numbers are refused", "[drift][bad input]") {
  CHECK(setpoint_means({{0, 1}, {4.0}}).error().code == Errc::bad_input);
  CHECK(setpoint_means({{0, 1}, {4.0, std::nan("")}}).error().code == Errc::bad_input);
  CHECK(setpoint_means({{0, 1}, {4.0, 4.1}}, {0.1, 0.0}).error().code == Errc::bad_input);
}
