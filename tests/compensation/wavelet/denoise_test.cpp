#include "compensation/wavelet/denoise.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "compensation/wavelet/median_magnitude.h"

using namespace gyrocal;

namespace {

std::vector<double> white_noise(std::size_t length, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  std::vector<double> signal(length);
  for (double& x : signal) x = normal(random);
  return signal;
}

double deviation_of(std::span<const double> values) {
  double mean = 0.0;
  for (const double x : values) mean += x / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double x : values) sum += (x - mean) * (x - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> shrunk(std::vector<double> details, double threshold, Shrinkage shrinkage) {
  shrink(details, threshold, shrinkage);
  return details;
}

}  // namespace

TEST_CASE("shrinkage of -3, -1, 0, 1 and 2 at threshold 1", "[wavelet]") {
  const std::vector<double> details{-3, -1, 0, 1, 2};
  CHECK(shrunk(details, 1, Shrinkage::soft) == std::vector<double>{-2, 0, 0, 0, 1});
  CHECK(shrunk(details, 1, Shrinkage::hard) == std::vector<double>{-3, -1, 0, 1, 2});
  CHECK(shrunk(details, 1, Shrinkage::garrote) ==
        std::vector<double>{-3 + 1.0 / 3.0, 0, 0, 0, 1.5});
  CHECK(shrunk(details, 0, Shrinkage::soft) == details);
  CHECK(shrunk(details, 0, Shrinkage::garrote) == details);
}

TEST_CASE("the noise estimate is the median of |d| over the normal quartile", "[wavelet]") {
  std::vector<double> scratch;
  CHECK(robust_sigma(std::vector<double>{-1, 5, 2}, scratch) == 2 / 0.6744897501960817);
  CHECK(robust_sigma(std::vector<double>{-1, 5, 2, -4}, scratch) == 3 / 0.6744897501960817);
  CHECK(robust_sigma({}, scratch) == 0);
}

TEST_CASE("a long band's median is the one that sorting finds, wherever the large values lie",
          "[wavelet]") {
  std::vector<double> scratch;
  for (const std::size_t length : {499u, 500u, 501u, 1503u, 3000u}) {
    const std::vector<double> noise = white_noise(length, 1.0, 11);
    std::vector<double> few_levels = noise;
    for (double& x : few_levels) x = std::round(x);
    std::vector<double> misleading = noise;  // every value that is looked at first is far too large
    for (std::size_t i = 0; i < 99; ++i) misleading[i * length / 99] = 1e6;
    for (const auto& values : {noise, few_levels, misleading}) {
      std::vector<double> sorted = values;
      for (double& x : sorted) x = std::abs(x);
      std::sort(sorted.begin(), sorted.end());
      const double median = (sorted[length / 2] + sorted[(length - 1) / 2]) / 2;
      CHECK(median_magnitude(values, scratch) == median);
    }
  }
}

TEST_CASE("the four thresholds of a band worked by hand", "[wavelet]") {
  std::vector<double> scratch;
  const std::vector<double> band{0.5, -0.5, 4, -4};
  const auto threshold = [&](ThresholdChoice choice, double sigma) {
    return threshold_of(choice, band, sigma, 1024, scratch);
  };
  CHECK(threshold(ThresholdChoice::universal, 2) == 2 * std::sqrt(2 * std::log(1024.0)));
  CHECK(threshold(ThresholdChoice::minimax, 2) == 2 * (0.3936 + 0.1829 * 10));
  CHECK(threshold_of(ThresholdChoice::minimax, band, 2, 32, scratch) == 0);
  // mean d^2 = 8.125, signal variance 7.125
  CHECK(threshold(ThresholdChoice::bayes, 1) == 1 / std::sqrt(7.125));
  CHECK(threshold(ThresholdChoice::bayes, 3) == 4);  // nothing but noise: max |d|
  // risks at |x| = 0, 0.5, 4: 4, 4 - 4 + 4 * 0.25 = 1, 4 - 8 + 32.5 = 28.5
  CHECK(threshold(ThresholdChoice::sure, 1) == 0.5);
  CHECK(threshold(ThresholdChoice::sure, 0) == 0);
}

TEST_CASE("a constant series stays constant under every rule", "[wavelet]") {
  const std::vector<double> signal(100, 4.25);
  for (const char* rule : {"approximation", "soft-universal", "hard-sure", "garrote-minimax",
                           "soft-bayes", "garrote-bayes"}) {
    CAPTURE(rule);
    DenoiseSettings settings = default_denoise_settings();
    settings.rule = find_denoise_rule(rule).value();
    const auto result = denoise(signal, settings);
    REQUIRE(result.has_value());
    CHECK(result->sigma < 1e-14);
    for (const double x : result->denoised) CHECK(std::abs(x - 4.25) < 1e-13);
  }
}

TEST_CASE("the paper's filter takes a dwell of white noise to a fifth or less", "[wavelet]") {
  const auto result = denoise(white_noise(3000, 1.3102, 42), default_denoise_settings()).value();
  CHECK(result.denoised.size() == 3000);
  CHECK(result.thresholds.empty());
  CHECK(std::abs(result.sigma - 1.3102) < 0.1);
  // 1/sqrt(32) of it, give or take what 94 independent values allow
  CHECK(std::abs(deviation_of(result.denoised) - 1.3102 / std::sqrt(32.0)) < 0.06);
}

TEST_CASE("noise per level follows coloured noise", "[wavelet]") {
  std::vector<double> walk = white_noise(4096, 1, 5);
  for (std::size_t i = 1; i < walk.size(); ++i) walk[i] += walk[i - 1];
  DenoiseSettings settings = default_denoise_settings();
  settings.rule = Thresholding{Shrinkage::soft, ThresholdChoice::universal};
  const auto global = denoise(walk, settings).value();
  CHECK(global.sigma_by_level == std::vector<double>(5, global.sigma));
  settings.noise = NoiseEstimate::per_level;
  const auto levels = denoise(walk, settings).value();
  CHECK(levels.sigma == global.sigma);
  CHECK(levels.sigma_by_level.back() == levels.sigma);
  for (std::size_t i = 1; i < 5; ++i)
    CHECK(levels.sigma_by_level[i] < levels.sigma_by_level[i - 1]);
}

TEST_CASE("one denoiser gives each signal what a fresh one gives", "[wavelet]") {
  DenoiseSettings settings = default_denoise_settings();
  settings.rule = Thresholding{Shrinkage::garrote, ThresholdChoice::sure};
  Denoiser shared(settings);
  Denoised result;
  for (const std::size_t length : {3000u, 77u, 1500u}) {
    const auto signal = white_noise(length, 1, static_cast<unsigned>(length));
    REQUIRE(shared.run(signal, result).has_value());
    const auto fresh = denoise(signal, settings).value();
    CHECK(result.denoised == fresh.denoised);
    CHECK(result.thresholds == fresh.thresholds);
    CHECK(result.coefficients.coefficients == fresh.coefficients.coefficients);
  }
}

TEST_CASE("a sample that is no number is named", "[wavelet]") {
  std::vector<double> signal(64, 1.0);
  signal[17] = std::numeric_limits<double>::quiet_NaN();
  auto result = denoise(signal, default_denoise_settings());
  REQUIRE_FALSE(result.has_value());
  CHECK(result.error().code == Errc::not_finite);
  CHECK(result.error().what == "sample 17 of 64 is nan");
  signal[17] = -std::numeric_limits<double>::infinity();
  CHECK(denoise(signal, default_denoise_settings()).error().what == "sample 17 of 64 is -inf");
}

TEST_CASE("an unknown rule or mode is answered with the known ones", "[wavelet]") {
  const auto rule = find_denoise_rule("soft");
  REQUIRE_FALSE(rule.has_value());
  CHECK(rule.error().what == "unknown rule 'soft'");
  CHECK(rule.error().advice.starts_with("known rules: approximation soft-universal soft-sure"));
  CHECK(find_boundary("mirror").error().advice ==
        "known modes: symmetric periodization zero constant reflect periodic");
  CHECK(find_boundary("symetric").error().advice.ends_with("; is symmetric meant?"));
  CHECK(find_denoise_rule("soft-univeral").error().advice.ends_with("; is soft-universal meant?"));
}
