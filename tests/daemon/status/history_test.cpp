#include "daemon/status/history.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace gyrocal::status {
namespace {

Point at(double t_s, double chamber_c) {
  Point point;
  point.t_s = t_s;
  point.chamber_c = chamber_c;
  point.setpoint_c = 20;
  point.boards = {{chamber_c + 1, 4.0, missing}};
  return point;
}

}  // namespace

SCENARIO("points of one interval become their mean") {
  History history(100, 5);
  history.add(at(0, 10));
  history.add(at(2, 20));
  history.add(at(4, 30));
  history.add(at(5, 50));
  REQUIRE(history.points().size() == 2);
  CHECK(history.points()[0].t_s == 2);
  CHECK(history.points()[0].chamber_c == 20);
  CHECK(history.points()[0].boards[0].board_c == 21);
  CHECK(std::isnan(history.points()[0].boards[0].slope_k_per_h));
  CHECK(history.points()[1].chamber_c == 50);
}

SCENARIO("a board that is away for a while leaves a gap and no nonsense") {
  History history(100, 5);
  history.add(at(0, 10));
  Point away = at(5, 10);
  away.boards[0] = {};
  history.add(away);
  history.add(at(10, 12));
  REQUIRE(history.points().size() == 3);
  CHECK(std::isnan(history.points()[1].boards[0].board_c));
  CHECK(history.points()[2].boards[0].board_c == 13);
}

SCENARIO("a weekend takes no more room than an hour, and its means stay true") {
  History history(1000, 5);
  double sum = 0;
  const int points = 48 * 720;
  for (int i = 0; i < points; ++i) {
    const double chamber_c = 20 + 10 * std::sin(i * 1e-3);
    history.add(at(5.0 * i, chamber_c));
    sum += chamber_c;
  }
  CHECK(history.points().size() <= 1000);
  CHECK(history.points().size() > 500);
  CHECK(history.interval_s() == 320);
  double t_s = -1;
  double mean = 0;
  for (const Point& point : history.points()) {
    CHECK(point.t_s > t_s);
    t_s = point.t_s;
    mean += point.chamber_c / double(history.points().size());
  }
  CHECK(mean == Approx(sum / points).epsilon(1e-9));
}

SCENARIO("a point from before the latest interval is left out") {
  History history(100, 5);
  history.add(at(100, 10));
  history.add(at(50, 99));
  REQUIRE(history.points().size() == 1);
  CHECK(history.points()[0].chamber_c == 10);
}

}  // namespace gyrocal::status
