#include "drivers/board/sample_clock.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace gyrocal;
using namespace gyrocal::inemo;

namespace {

/// Frames 1, 2, ... of a board whose period is off by `ppm`, each read alone after a random delay
/// of mostly below a millisecond. Returns the worst error of the time given to a frame, after
/// `settle_s`.
double worst_error_s(double ppm, double duration_s, double settle_s, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> delay(2000);
  SampleClock clock(50);
  const double period = 0.02 * (1 + ppm * 1e-6);
  double worst = 0;
  for (std::uint32_t n = 1; n * period < duration_s; ++n) {
    const double taken = 100 + n * period;
    clock.observe(n, Instant{seconds(taken + 28e-6 + delay(random))});
    if (n * period < settle_s) continue;
    const double error = to_seconds(clock.time_of(n).time_since_epoch()) - taken;
    worst = std::max(worst, std::abs(error));
  }
  return worst;
}

}  // namespace

TEST_CASE("a steady board read at once is timed to the microsecond", "[sample_clock]") {
  SampleClock clock(50);
  for (std::uint32_t n = 1; n <= 50 * 600; ++n) clock.observe(n, Instant{seconds(7 + 0.02 * n)});
  CHECK(std::abs(to_seconds(clock.time_of(30000) - Instant{seconds(607)})) < 1e-6);
  CHECK(std::abs(to_seconds(clock.time_of(29000) - Instant{seconds(587)})) < 1e-6);
  CHECK(clock.ticks_missed() == 0);
}

TEST_CASE("delays and a crystal 75 ppm off cost less than a millisecond",
          "[sample_clock][property]") {
  const auto seed = GENERATE(range(0u, 4u));
  const double ppm = GENERATE(-75.0, 0.0, 20.0, 75.0);
  CAPTURE(seed, ppm);
  CHECK(worst_error_s(ppm, 1800, 400, seed) < 1e-3);
  CHECK(worst_error_s(ppm, 60, 0, seed) < 6e-3);  // before the rate can be told
}

TEST_CASE("frames read in batches are timed by the newest of each", "[sample_clock]") {
  SampleClock clock(50);
  for (std::uint32_t n = 250; n <= 50 * 900; n += 250) {
    clock.observe(n, Instant{seconds(0.02 * n + 0.004)});
  }
  CHECK(std::abs(to_seconds(clock.time_of(44900) - Instant{seconds(898.004)})) < 1e-6);
}

TEST_CASE("a reader that was away for three seconds moves no sample", "[sample_clock]") {
  SampleClock clock(50);
  for (std::uint32_t n = 1; n <= 1000; ++n) {
    const double taken = 0.02 * n;
    const bool away = taken > 10 && taken < 13;
    clock.observe(n, Instant{seconds(away ? 13 : taken)});
  }
  CHECK(std::abs(to_seconds(clock.time_of(1000) - Instant{seconds(20)})) < 1e-6);
  CHECK(std::abs(to_seconds(clock.time_of(600) - Instant{seconds(12)})) < 1e-6);
  CHECK(clock.ticks_missed() == 0);
}

TEST_CASE("ticks the board slept through are counted and move the samples after them",
          "[sample_clock]") {
  SampleClock clock(50);
  for (std::uint32_t n = 1; n <= 2000; ++n) {
    const double taken = 0.02 * (n <= 500 ? n : n + 7);
    clock.observe(n, Instant{seconds(taken)});
  }
  CHECK(clock.ticks_missed() == 7);
  CHECK(std::abs(to_seconds(clock.time_of(2000) - Instant{seconds(0.02 * 2007)})) < 1e-6);
}

TEST_CASE("a board that stops for an hour and goes on is not taken for a slow one",
          "[sample_clock]") {
  SampleClock clock(50);
  for (std::uint32_t n = 1; n <= 3000; ++n) {
    clock.observe(n, Instant{seconds(0.02 * n + (n > 1500 ? 3600 : 0))});
  }
  CHECK(clock.ticks_missed() == 180000);
  CHECK(std::abs(to_seconds(clock.time_of(3000) - Instant{seconds(3660)})) < 1e-6);
}
