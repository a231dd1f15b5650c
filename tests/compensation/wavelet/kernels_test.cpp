#include "compensation/wavelet/kernels.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <vector>

using namespace gyrocal;

namespace {

constexpr std::size_t longest = 1100;  // beyond two blocks of analyse
constexpr std::size_t longest_filter = 15;

struct Output {
  std::vector<double> values[4];
  bool operator==(const Output&) const = default;
};

Output run_all(const Kernels& kernels, const std::vector<double>& data, std::size_t count,
               std::size_t half_taps) {
  Output output;
  for (auto& values : output.values) values.resize(2 * count);
  const double* const a = data.data();
  const double* const b = a + longest;
  const double* const lo = a + 50;
  const double* const hi = a + 90;
  kernels.analyse(a, count, lo, hi, half_taps, output.values[0].data(),
                  output.values[0].data() + count);
  kernels.analyse_long(a, count, lo, hi, half_taps, output.values[1].data(),
                       output.values[1].data() + count, count > 40 ? a : nullptr);
  kernels.synthesise(a, b, count, lo, hi, half_taps, output.values[2].data());
  kernels.synthesise(a, nullptr, count, lo, hi, half_taps, output.values[3].data());
  return output;
}

}  // namespace

TEST_CASE("every instruction set gives the portable result to the last bit",
          "[wavelet][property]") {
  const unsigned seed = 3;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> data(2 * (longest + longest_filter));
  for (double& x : data) x = normal(random);
  std::vector<std::size_t> counts(150);
  std::iota(counts.begin(), counts.end(), std::size_t{0});
  counts.insert(counts.end(), {511, 512, 513, 1023, 1024, longest});
  const Kernels& portable = *kernels_for(InstructionSet::portable);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    const Kernels* const wide = kernels_for(set);
    if (wide == nullptr) {
      WARN("this machine lacks instruction set " << static_cast<int>(set));
      continue;
    }
    for (const std::size_t count : counts) {
      for (const std::size_t half_taps : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 15u}) {
        CAPTURE(static_cast<int>(set), count, half_taps);
        const Output output = run_all(*wide, data, count, half_taps);
        REQUIRE(output == run_all(portable, data, count, half_taps));
        REQUIRE(output.values[1] == output.values[0]);
      }
    }
  }
}
