#include "config/setpoints.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace gyrocal;

namespace {
std::vector<double> visited(const std::vector<double>& listed_c, Sweep sweep,
                            std::uint64_t seed = 1) {
  std::vector<Celsius> points;
  for (const double c : listed_c) points.push_back({c});
  std::vector<double> order;
  for (const Celsius point : in_visiting_order(points, sweep, seed)) order.push_back(point.value);
  return order;
}
}  // namespace

TEST_CASE("a sweep up ascends, up_down comes back without repeating the top", "[config]") {
  CHECK(visited({20, -10, 5}, Sweep::up) == std::vector<double>{-10, 5, 20});
  CHECK(visited({20, -10, 5}, Sweep::up_down) == std::vector<double>{-10, 5, 20, 5, -10});
  CHECK(visited({20}, Sweep::up_down) == std::vector<double>{20});
  CHECK(visited({20, -10, 20}, Sweep::as_listed) == std::vector<double>{20, -10, 20});
}

TEST_CASE("a shuffled sweep is the same on every machine for one seed", "[config]") {
  const std::vector<double> listed{1, 2, 3, 4, 5, 6, 7, 8};
  CHECK(visited(listed, Sweep::shuffled, 1) ==
        visited({8, 7, 6, 5, 4, 3, 2, 1}, Sweep::shuffled, 1));
  CHECK(visited(listed, Sweep::shuffled, 1) == std::vector<double>{5, 4, 3, 8, 6, 7, 1, 2});
  CHECK(visited(listed, Sweep::shuffled, 2) != visited(listed, Sweep::shuffled, 1));
}

TEST_CASE("whatever the seed, a shuffled sweep visits each setpoint once", "[config][property]") {
  const auto seed = GENERATE(range<std::uint64_t>(0, 200));
  CAPTURE(seed);
  auto order = visited({5, 4, 3, 2, 1, 0}, Sweep::shuffled, seed);
  std::sort(order.begin(), order.end());
  CHECK(order == std::vector<double>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("the paper's plan has 25 setpoints from -10 to 50 degC", "[config]") {
  const auto points = paper_setpoints();
  CHECK(points.size() == 25);
  CHECK(points.at(5) == Celsius{3});
  CHECK(std::is_sorted(points.begin(), points.end()));
}
