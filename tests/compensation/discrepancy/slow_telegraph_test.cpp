// Two levels that switch within bins, within rows' reach: too slow for a dwell, too fast for bins.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "tests/compensation/quiet_rig.h"

using namespace gyrocal;

namespace {

/// Instants at which something switches at random, this often on average.
std::vector<double> flips(double stay_s, double end_s) {
  std::mt19937 random(5);
  std::exponential_distribution<double> stay(1 / stay_s);
  std::vector<double> at;
  for (double t_s = stay(random); t_s < end_s; t_s += stay(random)) at.push_back(t_s);
  return at;
}

Session switching(double stay_s, double level_dps) {
  const Session quiet = quiet_session(11);
  const auto at = flips(stay_s, quiet.monitor.back().t_s + 100);
  return with_drift(quiet, [&](double t_s) {
    const auto before = std::upper_bound(at.begin(), at.end(), t_s) - at.begin();
    return before % 2 == 0 ? 0.0 : level_dps;
  });
}

/// A walk that forgets within `tau_s`: the same spectrum, and no levels.
Session forgetting(double tau_s, double sd_dps) {
  const Session quiet = quiet_session(11);
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  std::vector<double> walk{sd_dps * normal(random)};
  const double keep = std::exp(-1 / tau_s);
  while (static_cast<double>(walk.size()) < quiet.monitor.back().t_s + 100) {
    walk.push_back(keep * walk.back() + std::sqrt(1 - keep * keep) * sd_dps * normal(random));
  }
  return with_drift(quiet, [&](double t_s) { return walk[static_cast<std::size_t>(t_s)]; });
}

}  // namespace

TEST_CASE("two levels are told from stays of a bin to stays of half an hour") {
  for (const double stay_s : {40.0, 150.0, 600.0}) {
    CAPTURE(stay_s);
    const auto found = diagnose(switching(stay_s, 0.08), {}, {});
    REQUIRE(found.has_value());
    CHECK(found->verdict == Verdict::explained);
    REQUIRE(found->findings.size() == 1);
    CHECK(found->findings[0].effect == "random_telegraph_noise");
    CHECK(found->findings[0].amplitude == Approx(80).epsilon(0.1));
  }
}

TEST_CASE("Gaussian noise of the same spectrum is no telegraph") {
  const auto found = diagnose(forgetting(150, 0.04), {}, {});
  REQUIRE(found.has_value());
  for (const Finding& finding : found->findings) {
    CHECK(finding.effect != "random_telegraph_noise");
  }
}
