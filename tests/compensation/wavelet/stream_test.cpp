#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "compensation/wavelet/dwt_level.h"
#include "compensation/wavelet/dwt_stream.h"

using namespace gyrocal;

namespace {

struct Bands {
  std::vector<std::vector<double>> details;
  std::vector<double> low;
  bool operator==(const Bands&) const = default;
};

Bands empty_bands(std::size_t length, const FilterBank& bank, Boundary boundary, int levels) {
  Bands bands;
  for (int i = 0; i < levels; ++i) {
    length = band_length(length, bank.taps(), boundary);
    bands.details.emplace_back(length);
  }
  bands.low.resize(length);
  return bands;
}

Bands level_by_level(const std::vector<double>& signal, const FilterBank& bank, Boundary boundary,
                     int levels) {
  Bands bands = empty_bands(signal.size(), bank, boundary, levels);
  std::vector<double> from = signal;
  for (auto& details : bands.details) {
    std::vector<double> low(details.size());
    analyse_level(from, bank, boundary, low, details);
    from = low;
  }
  bands.low = from;
  return bands;
}

Bands streamed(const std::vector<double>& signal, const FilterBank& bank, Boundary boundary,
               int levels) {
  Bands bands = empty_bands(signal.size(), bank, boundary, levels);
  std::vector<std::span<double>> details(bands.details.begin(), bands.details.end());
  stream_levels(signal, bank, boundary, details, bands.low);
  return bands;
}

}  // namespace

TEST_CASE("a long signal in one pass gives what level by level gives, to the last bit",
          "[wavelet][property]") {
  const unsigned seed = 17;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::size_t length : {262144u, 262145u, 300007u, 266302u}) {
    std::vector<double> signal(length);
    for (double& x : signal) x = uniform(random);
    for (const char* name : {"haar", "db4", "db5", "coif5"}) {
      const FilterBank& bank = *find_filter_bank(name).value();
      REQUIRE(worth_streaming(length, bank.taps()));
      for (const Boundary boundary : all_boundaries) {
        for (const int levels : {1, 2, 6}) {
          CAPTURE(length, name, name_of(boundary), levels);
          CHECK(streamed(signal, bank, boundary, levels) ==
                level_by_level(signal, bank, boundary, levels));
        }
      }
    }
  }
}
