#include "compensation/discrepancy/dwell_codes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compensation/discrepancy/slow_story.h"
#include "tests/compensation/discrepancy/made_dwell.h"

using namespace gyrocal;

namespace {

constexpr double lsb_dps = 0.05;
constexpr double sd_dps = 0.2;

/// Dwells whose rates climb, against a rail at 5 dps.
std::vector<DwellData> climbing_to(double highest_dps, double lowest_dps = 3) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> noise(0, sd_dps);
  std::vector<DwellData> dwells;
  for (int d = 0; d < 12; ++d) {
    const double rate_dps = lowest_dps + (highest_dps - lowest_dps) * d / 11.0;
    dwells.push_back(made_dwell(d, 2000, [&] {
      return std::min(std::round((rate_dps + noise(random)) / lsb_dps) * lsb_dps, 5.0);
    }));
  }
  return dwells;
}

}  // namespace

TEST_CASE("dwells that reach the rail show the rail and no outliers") {
  const double highest_dps = GENERATE(4.9, 5.1, 5.4);
  CAPTURE(highest_dps);
  const CodeFindings found = inspect_codes(climbing_to(highest_dps), lsb_dps);
  CHECK(found.upper_nats > gate_nats);
  CHECK(found.upper_dps == Approx(5.0));
  CHECK(found.outliers == 0);
}

TEST_CASE("a rail that a few dwells only touch with their tails is told") {
  std::mt19937_64 random(19);
  std::normal_distribution<double> noise(0, 0.096);
  std::vector<DwellData> dwells;
  for (const double rate_dps : {1.86, 1.85, 1.81, 1.52, 1.85, 1.76, 1.88, 1.63, 1.72, 1.88}) {
    const int number = static_cast<int>(dwells.size());
    dwells.push_back(made_dwell(number, 2000, [&] {
      return std::min(std::round((rate_dps + noise(random)) / 0.12) * 0.12, 17 * 0.12);
    }));
  }
  const CodeFindings found = inspect_codes(dwells, 0.12);
  CHECK(found.upper_nats > gate_nats);
  CHECK(found.upper_dps == Approx(2.04));
}

TEST_CASE("where every dwell is cut off, what is left tells the noise") {
  const CodeFindings found = inspect_codes(climbing_to(5.3, 4.9), lsb_dps);
  CHECK(found.upper_nats > gate_nats);
  CHECK(found.white_sd_dps == Approx(sd_dps).epsilon(0.05));
  CHECK(found.outliers == 0);
  CHECK(found.holes.empty());
}

TEST_CASE("a coarse converter whose last dwell keeps to one code has no rail") {
  auto dwells = climbing_to(4.9);
  for (DwellData& dwell : dwells) {
    for (double& y : dwell.y_dps) y = std::round(y / 0.4) * 0.4;
  }
  std::fill(dwells.back().y_dps.begin(), dwells.back().y_dps.end(), 4.8);
  CHECK(inspect_codes(dwells, 0.4).upper_nats < gate_nats);
}

TEST_CASE("a glitch far below the rail still counts") {
  auto dwells = climbing_to(5.4);
  for (std::size_t d = 0; d < 8; ++d) dwells[d].y_dps[500] = 1.0;
  const CodeFindings found = inspect_codes(dwells, lsb_dps);
  CHECK(found.outliers == 8);
  CHECK(found.outliers_one_sided);
}

TEST_CASE("two levels make runs in a coarse converter, and no sample sticks") {
  constexpr double coarse_dps = 0.1;  // a deviation of the noise
  std::mt19937_64 random(23);
  std::normal_distribution<double> noise(0, coarse_dps);
  std::bernoulli_distribution flips(0.03);
  std::vector<DwellData> dwells;
  for (int d = 0; d < 12; ++d) {
    bool high = false;
    dwells.push_back(made_dwell(d, 3000, [&] {
      if (flips(random)) high = !high;
      return std::round((4 + 2 * coarse_dps * high + noise(random)) / coarse_dps) * coarse_dps;
    }));
  }
  CHECK(inspect_codes(dwells, coarse_dps, true).stuck_nats < gate_nats);
  for (int i = 200; i < 230; ++i)
    dwells[5].y_dps[static_cast<std::size_t>(i)] = dwells[5].y_dps[200];
  const CodeFindings stuck = inspect_codes(dwells, coarse_dps, true);
  CHECK(stuck.stuck_nats > gate_nats);
  CHECK(stuck.stuck_length == Approx(30).margin(4));
}
