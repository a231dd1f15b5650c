#include "daemon/runner/slow_stream.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace gyrocal::runner {
namespace {

BoardSample sample(double t_s, std::uint32_t counter, std::int16_t z,
                   std::optional<std::int16_t> temperature = std::nullopt) {
  return {seconds(t_s).count(), counter, {1, -2, z}, temperature};
}

}  // namespace

SCENARIO("every sample is counted once, in the interval its time falls into") {
  SlowStream stream(seconds(5), seconds(0));
  std::vector<BoardSample> samples;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    samples.push_back(sample(0.02 * i, i + 1, static_cast<std::int16_t>(i / 250), 20 * 256));
  }
  stream.add(std::span(samples).first(333));
  stream.add(std::span(samples).subspan(333));
  stream.close_before(seconds(20));
  const auto rows = stream.take();
  REQUIRE(rows.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(rows[i].begin == seconds(5.0 * double(i)));
    CHECK(rows[i].frames == 250);
    CHECK(rows[i].frames_missing == 0);
    CHECK(rows[i].gyro_mean_lsb(0) == 1);
    CHECK(rows[i].gyro_mean_lsb(1) == -2);
    CHECK(rows[i].gyro_mean_lsb(2) == double(i));
    CHECK(rows[i].board_c() == 20);
  }
}

SCENARIO("an interval without frames says so instead of inventing a mean") {
  SlowStream stream(seconds(5), seconds(0));
  const std::vector<BoardSample> one = {sample(12, 1, 17)};
  stream.add(one);
  const auto rows = stream.take();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].frames == 0);
  CHECK(std::isnan(rows[0].gyro_mean_lsb(2)));
  CHECK(std::isnan(rows[0].board_c()));
}

SCENARIO("frames the counter misses are counted; a counter that starts anew is no loss") {
  SlowStream stream(seconds(5), seconds(0));
  const std::vector<BoardSample> samples = {sample(0, 10, 0), sample(0.1, 14, 0), sample(0.2, 1, 0),
                                            sample(0.3, 2, 0)};
  stream.add(samples);
  stream.close_before(seconds(5));
  CHECK(stream.take().at(0).frames_missing == 3);
}

SCENARIO("intervals are aligned to the campaign's start, also after a resume in between") {
  SlowStream stream(seconds(5), seconds(1003));
  stream.close_before(seconds(1005));
  CHECK(stream.take().at(0).begin == seconds(1000));
}

}  // namespace gyrocal::runner
