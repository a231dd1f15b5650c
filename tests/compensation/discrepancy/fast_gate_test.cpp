// The gate of lines, codes and counters is a constant. Here is what sessions without anything
// reach.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compensation/discrepancy/dwell_codes.h"
#include "compensation/discrepancy/dwell_spectrum.h"
#include "compensation/discrepancy/slow_story.h"
#include "tests/compensation/discrepancy/made_dwell.h"

using namespace gyrocal;

namespace {

struct Null {
  int dwells, samples;
  double sd_dps, lsb_dps;
};

std::vector<DwellData> null_dwells(const Null& null, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, null.sd_dps);
  std::vector<DwellData> dwells;
  for (int d = 0; d < null.dwells; ++d) {
    const double die_c = -10 + 60.0 * d / null.dwells;
    const double rate_dps = 4 + 0.01 * die_c;
    dwells.push_back(made_dwell(d, null.samples, [&] {
      return std::round((rate_dps + noise(random)) / null.lsb_dps) * null.lsb_dps;
    }));
    dwells.back().die_c = die_c;
  }
  return dwells;
}

double best_of_codes(const CodeFindings& codes) {
  return std::max({codes.holes_nats, codes.upper_nats, codes.lower_nats, codes.outlier_nats,
                   codes.stuck_nats, codes.spread_nats, codes.growth_nats, codes.lost_nats});
}

/// The share above `gate_nats` by an exponential through the largest fifth.
double share_above_gate(std::vector<double> best) {
  std::sort(best.begin(), best.end());
  const std::size_t from = best.size() * 4 / 5;
  double excess = 0;
  for (std::size_t i = from; i < best.size(); ++i) {
    excess += (best[i] - best[from - 1]) / static_cast<double>(best.size() - from);
  }
  return 0.2 * std::exp(-(gate_nats - best[from - 1]) / excess);
}

}  // namespace

TEST_CASE("without anything hidden the samples pass their gate less than once in a hundred",
          "[gate]") {
  const auto null = GENERATE(Null{25, 1000, 0.1, 0.05}, Null{25, 1000, 1.31, 0.242},
                             Null{12, 500, 0.1, 0.242}, Null{60, 600, 0.3, 0.05});
  const std::uint64_t seed = 61;
  CAPTURE(null.dwells, null.samples, null.sd_dps, null.lsb_dps, seed);
  std::mt19937_64 random(seed);
  std::vector<double> lines, codes;
  for (int session = 0; session < 150; ++session) {
    const auto dwells = null_dwells(null, random);
    const auto found = find_lines(dwell_spectrum(dwells, 50), dwells, 0);
    lines.push_back(found.empty() ? 0 : found.front().nats);
    codes.push_back(best_of_codes(inspect_codes(dwells, null.lsb_dps)));
  }
  const auto largest = [](const std::vector<double>& v) {
    return *std::max_element(v.begin(), v.end());
  };
  CAPTURE(largest(lines), largest(codes), share_above_gate(lines), share_above_gate(codes));
  const auto passed = [](const std::vector<double>& v) {
    return std::count_if(v.begin(), v.end(), [](double nats) { return nats > gate_nats; });
  };
  CHECK(passed(lines) <= 1);
  CHECK(passed(codes) <= 1);
  CHECK(share_above_gate(lines) < 0.01);
  CHECK(share_above_gate(codes) < 0.01);
}
