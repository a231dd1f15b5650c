#include "compensation/wavelet/kernels.h"

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace gyrocal;

namespace {

struct Output {
  std::vector<double> values[6];
  bool operator==(const Output&) const = default;
};

Output run_all(const Kernels& kernels, const std::vector<double>& data, std::size_t count,
               std::size_t half_taps) {
  Output output;
  for (auto& values : output.values) values.resize(2 * count);
  const double* const a = data.data();
  const double* const b = a + 64;
  const double* const lo = a + 400;
  const double* const hi = a + 440;
  kernels.split(a, count, output.values[0].data(), output.values[1].data());
  kernels.analyse(a, b, count, lo, hi, half_taps, output.values[2].data(),
                  output.values[2].data() + count);
  kernels.analyse_long(a, b, count, lo, hi, half_taps, output.values[5].data(),
                       output.values[5].data() + count, count > 40 ? a : nullptr);
  kernels.synthesise(a, b, count, lo, hi, half_taps, output.values[3].data());
  kernels.synthesise(a, nullptr, count, lo, hi, half_taps, output.values[4].data());
  return output;
}

}  // namespace

TEST_CASE("every instruction set gives the portable result to the last bit",
          "[wavelet][property]") {
  const unsigned seed = 3;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> data(600);
  for (double& x : data) x = normal(random);
  const Kernels& portable = *kernels_for(InstructionSet::portable);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    const Kernels* const wide = kernels_for(set);
    if (wide == nullptr) {
      WARN("this machine lacks instruction set " << static_cast<int>(set));
      continue;
    }
    for (std::size_t count = 0; count <= 150; ++count) {
      for (const std::size_t half_taps : {1u, 2u, 4u, 9u, 15u}) {
        CAPTURE(static_cast<int>(set), count, half_taps);
        REQUIRE(run_all(*wide, data, count, half_taps) ==
                run_all(portable, data, count, half_taps));
        const Output output = run_all(*wide, data, count, half_taps);
        REQUIRE(output.values[5] == output.values[2]);
      }
    }
  }
}
