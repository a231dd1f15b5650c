#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compensation/wavelet/dwt.h"

using namespace gyrocal;

namespace {

std::vector<double> noise(std::size_t length, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> signal(length);
  for (double& x : signal) x = uniform(random);
  return signal;
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The symlets' published filters are that far from orthonormal.
double reconstruction_tolerance(const FilterBank& bank) {
  return bank.name.starts_with("sym") ? 2e-10 : 2e-14;
}

}  // namespace

TEST_CASE("a signal comes back from its coefficients, whatever wavelet, mode, length and level",
          "[wavelet][property]") {
  const unsigned seed = 20260101;
  CAPTURE(seed);
  Workspace workspace;
  Decomposition bands;
  std::vector<double> back;
  for (const FilterBank& bank : filter_banks()) {
    for (const Boundary boundary : all_boundaries) {
      for (std::size_t length = 2; length <= 300; ++length) {
        const std::vector<double> signal = noise(length, seed + static_cast<unsigned>(length));
        for (const int level : {1, deepest_level(length)}) {
          const Wavelet wavelet{&bank, boundary, level};
          decompose_into(signal, wavelet, workspace, bands);
          reconstruct_into(bands, wavelet, workspace, back);
          const double difference = largest_difference(signal, back);
          if (!(difference < reconstruction_tolerance(bank))) {
            CAPTURE(bank.name, name_of(boundary), length, level, difference);
            FAIL("not reconstructed");
          }
        }
      }
    }
  }
}

TEST_CASE("the branches of a signal add up to the signal", "[wavelet][property]") {
  const unsigned seed = 7;
  CAPTURE(seed);
  for (const Boundary boundary : all_boundaries) {
    for (const std::size_t length : {33u, 64u, 257u}) {
      CAPTURE(name_of(boundary), length);
      const Wavelet wavelet{find_filter_bank("db4").value(), boundary, 3};
      const std::vector<double> signal = noise(length, seed);
      const auto bands = decompose(signal, wavelet).value();
      std::vector<double> sum(length);
      for (std::size_t band = 0; band < bands.bands(); ++band) {
        const auto branch = reconstruct_branch(bands, wavelet, band);
        for (std::size_t i = 0; i < length; ++i) sum[i] += branch[i];
      }
      CHECK(largest_difference(signal, sum) < 1e-14);
    }
  }
}

TEST_CASE("an orthogonal transform without overhang keeps the energy", "[wavelet]") {
  const std::vector<double> signal = noise(256, 11);
  const auto bands =
      decompose(signal, {find_filter_bank("coif2").value(), Boundary::periodization, 4}).value();
  const auto energy = [](std::span<const double> values) {
    double sum = 0.0;
    for (const double x : values) sum += x * x;
    return sum;
  };
  CHECK(bands.coefficients.size() == 256);
  CHECK(std::abs(energy(bands.coefficients) - energy(signal)) < 1e-12);
}

TEST_CASE("a level is refused when it has fewer samples than it would average", "[wavelet]") {
  const FilterBank* const haar = find_filter_bank("haar").value();
  const std::vector<double> signal(100, 1.0);
  CHECK(decompose(signal, {haar, Boundary::zero, 6}).has_value());

  const auto deep = decompose(signal, {haar, Boundary::zero, 7});
  REQUIRE_FALSE(deep.has_value());
  CHECK(deep.error() == Error{Errc::out_of_range, "level 7 cannot be reached with 100 samples",
                              "choose a level from 1 to 6"});
  CHECK(decompose(signal, {haar, Boundary::zero, 0}).error().code == Errc::out_of_range);

  const auto single = decompose(std::vector<double>{1.0}, {haar, Boundary::zero, 1});
  REQUIRE_FALSE(single.has_value());
  CHECK(single.error().code == Errc::too_few_points);
  CHECK(decompose({}, {haar, Boundary::zero, 1}).error().code == Errc::too_few_points);
}

TEST_CASE("the useful level is the one PyWavelets and MATLAB name", "[wavelet]") {
  CHECK(useful_level(3000, 8) == 8);
  CHECK(useful_level(25, 8) == 1);
  CHECK(useful_level(6, 8) == 0);
  CHECK(useful_level(1024, 2) == 10);
}
