#include "compensation/wavelet/denoise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compensation/values/assert.h"
#include "compensation/values/nearest_name.h"

namespace gyrocal {
namespace {

struct NamedShrinkage {
  std::string_view name;
  Shrinkage value;
};
struct NamedChoice {
  std::string_view name;
  ThresholdChoice value;
};
constexpr NamedShrinkage shrinkages[] = {
    {"soft", Shrinkage::soft}, {"hard", Shrinkage::hard}, {"garrote", Shrinkage::garrote}};
constexpr NamedChoice choices[] = {{"universal", ThresholdChoice::universal},
                                   {"sure", ThresholdChoice::sure},
                                   {"minimax", ThresholdChoice::minimax},
                                   {"bayes", ThresholdChoice::bayes}};

Result<void> check_finite(std::span<const double> signal) {
  const auto bad =
      std::find_if(signal.begin(), signal.end(), [](double x) { return !std::isfinite(x); });
  if (bad == signal.end()) return {};
  return fail(Errc::not_finite,
              fmt::format("sample {} of {} is {}", bad - signal.begin(), signal.size(), *bad),
              "leave out or repair samples that are no numbers (the first sample is 0)");
}

}  // namespace

Result<DenoiseRule> find_denoise_rule(std::string_view name) {
  if (name == "approximation") return ApproximationOnly{};
  std::vector<std::string> known{"approximation"};
  for (const auto& shrinkage : shrinkages) {
    for (const auto& choice : choices) {
      const std::string rule = fmt::format("{}-{}", shrinkage.name, choice.name);
      if (rule == name) return Thresholding{shrinkage.value, choice.value};
      known.push_back(rule);
    }
  }
  return fail(
      Errc::unknown_name, fmt::format("unknown rule '{}'", name),
      known_names("rules", name, std::vector<std::string_view>(known.begin(), known.end())));
}

DenoiseSettings default_denoise_settings() {
  const auto db4 = find_filter_bank("db4");
  GYROCAL_ASSERT(db4.has_value());
  return {.wavelet = {.bank = *db4, .boundary = Boundary::symmetric, .level = 5}};
}

void Denoiser::threshold_details(std::size_t signal_length, const Thresholding& rule,
                                 Denoised& result) {
  shrunk_ = result.coefficients;
  for (std::size_t band = 1; band < shrunk_.bands(); ++band) {
    const double threshold = threshold_of(rule.choice, result.coefficients.band(band),
                                          result.sigma_by_level[band - 1], signal_length, scratch_);
    result.thresholds.push_back(threshold);
    shrink(shrunk_.band(band), threshold, rule.shrinkage);
  }
}

Result<void> Denoiser::run(std::span<const double> signal, Denoised& result) {
  if (const auto deep = check_level(signal.size(), settings_.wavelet.level); !deep) return deep;
  if (const auto finite = check_finite(signal); !finite) return finite;
  decompose_into(signal, settings_.wavelet, workspace_, result.coefficients);

  const Decomposition& bands = result.coefficients;
  result.sigma = robust_sigma(bands.band(bands.bands() - 1), scratch_);
  result.sigma_by_level.assign(bands.bands() - 1, result.sigma);
  if (settings_.noise == NoiseEstimate::per_level) {
    for (std::size_t band = 1; band + 1 < bands.bands(); ++band) {
      result.sigma_by_level[band - 1] = robust_sigma(bands.band(band), scratch_);
    }
  }

  result.thresholds.clear();
  if (const auto* rule = std::get_if<Thresholding>(&settings_.rule)) {
    threshold_details(signal.size(), *rule, result);
    reconstruct_into(shrunk_, settings_.wavelet, workspace_, result.denoised);
  } else {
    reconstruct_approximation_into(bands, settings_.wavelet, workspace_, result.denoised);
  }
  return {};
}

Result<Denoised> denoise(std::span<const double> signal, const DenoiseSettings& settings) {
  Denoised result;
  if (const auto done = Denoiser(settings).run(signal, result); !done) {
    return tl::unexpected(done.error());
  }
  return result;
}

}  // namespace gyrocal
