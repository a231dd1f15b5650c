#include "compensation/drift/allan_pieces.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

TEST_CASE("samples are cut at dwells, lost frames and missing values", "[allan]") {
  std::vector<SessionSample> samples;
  const auto add = [&](int dwell, int seq, double gyro) {
    SessionSample sample;
    sample.dwell = dwell;
    sample.seq = seq;
    sample.gyro_dps = gyro;
    samples.push_back(sample);
  };
  add(0, 0, 1);
  add(0, 1, 2);
  add(0, 3, 3);
  add(0, 4, missing);
  add(0, 5, 4);
  add(1, 6, 5);
  using Pieces = std::vector<std::vector<double>>;
  CHECK(unbroken_pieces(samples, std::nullopt) == Pieces{{1, 2}, {3}, {4}, {5}});
  CHECK(unbroken_pieces(samples, 1) == Pieces{{5}});
  CHECK(unbroken_pieces(samples, 2).empty());
}
