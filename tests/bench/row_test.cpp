#include "tests/bench/row.h"

#include <catch2/catch.hpp>

using namespace gyrocal::bench;

TEST_CASE("a spread is the middle, the least and the most", "[bench]") {
  const Spread spread = spread_of({3, 9, 1, 2, 4});
  CHECK(spread.median == 3);
  CHECK(spread.least == 1);
  CHECK(spread.most == 9);
}

TEST_CASE("the exponent of a power is that power, whatever the factor", "[bench]") {
  CHECK(exponent({1, 10, 100}, {7, 70, 700}) == Approx(1));
  CHECK(exponent({2, 4, 8}, {3, 12, 48}) == Approx(2));
  CHECK(exponent({1, 10, 1000}, {5, 5, 5}) == Approx(0).margin(1e-12));
}

TEST_CASE("times stand in a unit of their own, to three digits", "[bench]") {
  CHECK(shown_s({1.234e-6, 1e-6, 2e-3}) == "1.23 us [1, 2000]");
  CHECK(shown_s({0.9999e-3, 0.9e-3, 1e-3}) == "1 ms [0.9, 1]");
  CHECK(shown_s({12.34, 1, 100}) == "12.3 s [1, 100]");
}

TEST_CASE("a row says whether its limit is met", "[bench]") {
  CHECK(within("a job", {0.9, 0.8, 2}, 1.0, "").met == true);
  CHECK(within("a job", {1.1, 0.8, 2}, 1.0, "").met == false);
  CHECK_FALSE(within("a job", {1.1, 0.8, 2}, {}, "").met.has_value());
  const Row faster = against("a job", {1, 1, 1}, {"peer", Spread{12, 11, 13}, ""}, 10, "");
  CHECK(faster.met == true);
  CHECK(faster.ratio == "12 x");
  CHECK(against("a job", {2, 2, 2}, {"peer", Spread{12, 11, 13}, ""}, 10, "").met == false);
}

TEST_CASE("a peer that is not there says how to get it, and judges nothing", "[bench]") {
  const Row row = against("a job", {1, 1, 1}, {"peer", {}, "python3-peer"}, 10, "");
  CHECK(row.peer_took == "absent: apt-get install python3-peer");
  CHECK(row.ratio.empty());
  CHECK_FALSE(row.met.has_value());
}
