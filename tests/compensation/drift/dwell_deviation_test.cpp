#include "compensation/drift/dwell_deviation.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gyrocal;

namespace {

struct Pooled {
  double raw = 0, filtered = 0;
};

Pooled pooled(const std::vector<DwellDeviation>& dwells) {
  Pooled sum;
  for (const auto& d : dwells) {
    sum.raw += d.raw_dps * d.raw_dps;
    sum.filtered += d.filtered_dps * d.filtered_dps;
  }
  const auto n = static_cast<double>(dwells.size());
  return {std::sqrt(sum.raw / n), std::sqrt(sum.filtered / n)};
}

}  // namespace

TEST_CASE("level L keeps one part in sqrt(2^L) of white noise", "[drift][property]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  CAPTURE(seed);
  WhiteDwells dwells;
  dwells.seed = seed;
  auto settings = default_denoise_settings();
  for (int level = 1; level <= 6; ++level) {
    CAPTURE(level);
    settings.wavelet.level = level;
    const auto deviations = dwell_deviations(dwells, settings);
    REQUIRE(deviations.has_value());
    REQUIRE(deviations->size() == 25);
    const auto [raw, filtered] = pooled(*deviations);
    CHECK(raw == Approx(1.3102).epsilon(0.015));  // 75 000 samples: 0.3 % standard error
    CHECK(filtered == Approx(1.3102 / std::sqrt(std::pow(2, level))).epsilon(0.06));
  }
}

TEST_CASE("the same seed gives the same dwells", "[drift]") {
  const auto once = dwell_deviations({}, default_denoise_settings());
  const auto again = dwell_deviations({}, default_denoise_settings());
  REQUIRE(once.has_value());
  CHECK(once->front().filtered_dps == again->front().filtered_dps);
  WhiteDwells other;
  other.seed = 2;
  CHECK(once->front().raw_dps !=
        dwell_deviations(other, default_denoise_settings())->front().raw_dps);
}

TEST_CASE("the filter leaves the mean of a dwell where it was", "[drift]") {
  // A tenth of the mean's own standard error, 1.3102 / sqrt(3000).
  const auto dwells = dwell_deviations({}, default_denoise_settings());
  REQUIRE(dwells.has_value());
  for (const auto& dwell : *dwells) {
    CHECK(dwell.mean_moved_dps < 0.1 * 1.3102 / std::sqrt(3000));
  }
}
