#include "daemon/campaign/pace.h"

#include <catch2/catch.hpp>

namespace gyrocal::campaign {
namespace {

/// Ten setpoints of a planned hour each; `took_s` of those visited.
struct Visited {
  explicit Visited(const std::vector<double>& took_s) {
    pace.heading_for(0, t, planned());
    for (const double s : took_s) {
      t += seconds(s);
      ++point;
      pace.heading_for(point, t, planned());
    }
  }
  [[nodiscard]] Duration planned() const {
    return std::chrono::hours{10 - static_cast<int>(point)};
  }
  [[nodiscard]] double left_h(double into_s = 0) const {
    const Duration now_planned = planned() - seconds(std::min(into_s, 3600.0));
    return to_seconds(pace.left(t + seconds(into_s), now_planned, 9 - point)) / 3600;
  }
  Pace pace;
  Duration t = seconds(500);
  std::size_t point = 0;
};

}  // namespace

SCENARIO("setpoints that take what the plan says leave its estimate as it is") {
  CHECK(Visited({}).left_h() == Approx(10));
  CHECK(Visited({3600, 3600, 3600}).left_h() == Approx(7));
}

SCENARIO("setpoints that take half as long again move the end") {
  CHECK(Visited({5400}).left_h() == Approx(9));  // one is no pace
  const Visited late({5400, 5400, 5400, 5400});
  CHECK(late.left_h() == Approx(9));
  CHECK(late.left_h(3600) == Approx(8));
  CHECK(late.left_h(4500) == Approx(7.75));  // half of what is usual has gone
  CHECK(late.left_h(9000) == Approx(7.5));   // later than usual: nothing more is known of it
  CHECK(Visited({2700, 2700}).left_h() == Approx(6.25));  // and those that are faster
}

SCENARIO("one skipped or one given up does not move the end") {
  CHECK(Visited({3600, 60, 3600}).left_h() == Approx(7));
  CHECK(Visited({3600, 7200, 3600}).left_h() == Approx(7));
}

SCENARIO("a pause, and a second try at a setpoint, are told from its pace") {
  Visited visited({5400, 5400});
  visited.pace.stood_still(std::chrono::hours{5});
  visited.t += seconds(5 * 3600 + 1800);
  visited.pace.heading_for(visited.point, visited.t, visited.planned());  // tried again
  visited.t += seconds(3600);
  ++visited.point;
  visited.pace.heading_for(visited.point, visited.t, visited.planned());
  CHECK(visited.left_h() == Approx(7 + 3.5));
}

}  // namespace gyrocal::campaign
