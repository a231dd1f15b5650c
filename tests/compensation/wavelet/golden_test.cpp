#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "compensation/wavelet/denoise.h"

using namespace gyrocal;

namespace {

constexpr double golden_tolerance = 1e-9;

double off_golden(std::span<const double> ours, const nlohmann::json& golden) {
  if (ours.size() != golden.size()) return INFINITY;
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    largest = std::max(largest, std::abs(ours[i] - golden[i].get<double>()));
  }
  return largest;
}

Denoised denoised(const nlohmann::json& golden, const char* rule) {
  DenoiseSettings settings = default_denoise_settings();
  settings.wavelet = {find_filter_bank(golden.at("wavelet").get<std::string>()).value(),
                      find_boundary(golden.at("mode").get<std::string>()).value(),
                      golden.at("level").get<int>()};
  settings.rule = find_denoise_rule(rule).value();
  return denoise(golden.at("signal").get<std::vector<double>>(), settings).value();
}

}  // namespace

TEST_CASE("coefficients, thresholds and denoised signals are the golden ones",
          "[wavelet][golden]") {
  std::ifstream file(GYROCAL_SOURCE_DIR "/tests/golden/wavelet.json");
  const auto cases = nlohmann::json::parse(file).at("cases");
  CHECK(cases.size() == 9);
  for (const auto& golden : cases) {
    CAPTURE(golden.at("wavelet"), golden.at("mode"), golden.at("level"));
    const Denoised approximation = denoised(golden, "approximation");
    const auto& bands = golden.at("coeffs_cA_then_cD_coarse_to_fine");
    REQUIRE(approximation.coefficients.bands() == bands.size());
    for (std::size_t band = 0; band < bands.size(); ++band) {
      CHECK(off_golden(approximation.coefficients.band(band), bands[band]) < golden_tolerance);
    }
    CHECK(std::abs(approximation.sigma - golden.at("sigma_mad").get<double>()) < golden_tolerance);
    CHECK(off_golden(approximation.denoised, golden.at("approximation_only")) < golden_tolerance);

    const Denoised soft = denoised(golden, "soft-universal");
    for (const double threshold : soft.thresholds) {
      CHECK(std::abs(threshold - golden.at("threshold_universal").get<double>()) <
            golden_tolerance);
    }
    CHECK(off_golden(soft.denoised, golden.at("denoised_soft_universal")) < golden_tolerance);
    CHECK(off_golden(denoised(golden, "hard-universal").denoised,
                     golden.at("denoised_hard_universal")) < golden_tolerance);

    const Denoised bayes = denoised(golden, "soft-bayes");
    CHECK(off_golden(bayes.thresholds, golden.at("bayes_thresholds_coarse_to_fine")) <
          golden_tolerance);
    CHECK(off_golden(bayes.denoised, golden.at("denoised_soft_bayes")) < golden_tolerance);
  }
}
