#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/wavelet/dwt.h"
#include "compensation/wavelet/threshold.h"

namespace gyrocal {

/// Keeps the approximation cA_L alone (the paper's filter: wrcoef 'a').
struct ApproximationOnly {
  bool operator==(const ApproximationOnly&) const = default;
};
/// Keeps the approximation and what is left of the details after thresholding.
struct Thresholding {
  Shrinkage shrinkage;
  ThresholdChoice choice;
  bool operator==(const Thresholding&) const = default;
};
using DenoiseRule = std::variant<ApproximationOnly, Thresholding>;

/// "approximation", or "soft", "hard" or "garrote", a hyphen, and "universal", "sure", "minimax" or
/// "bayes".
[[nodiscard]] Result<DenoiseRule> find_denoise_rule(std::string_view name);

/// Where the deviation of the noise is taken from: `global` from the finest details cD_1 (white
/// noise), `per_level` from each band (coloured noise).
enum class NoiseEstimate { global, per_level };

/// The defaults are the paper's filter.
struct DenoiseSettings {
  Wavelet wavelet;  ///< see default_denoise_settings()
  DenoiseRule rule = ApproximationOnly{};
  NoiseEstimate noise = NoiseEstimate::global;
};

/// db4, symmetric, level 5, approximation: takes a dwell of white noise from a deviation of 1 to
/// about 1/sqrt(32), as the paper's 1.3102 -> 0.2488 deg/s.
[[nodiscard]] DenoiseSettings default_denoise_settings();

struct Denoised {
  Decomposition coefficients;          ///< before thresholding
  double sigma = 0;                    ///< deviation of the noise, from cD_1
  std::vector<double> sigma_by_level;  ///< coarse to fine; all equal for NoiseEstimate::global
  std::vector<double> thresholds;      ///< coarse to fine; empty for ApproximationOnly
  std::vector<double> denoised;        ///< as many as the signal
};

/// Filters signals one after the other; memory is allocated for the longest only. One thread each.
class Denoiser {
 public:
  explicit Denoiser(DenoiseSettings settings) : settings_(settings) {}

  /// @param signal  n samples of any unit; n >= 2, finite.
  /// @return in `result`, in the unit of the signal; on an error `result` is as before. Errors:
  /// not_finite with the index, and those of check_level(). O(n taps), O(n log n) for sure.
  [[nodiscard]] Result<void> run(std::span<const double> signal, Denoised& result);

 private:
  void threshold_details(std::size_t signal_length, const Thresholding& rule, Denoised& result);

  DenoiseSettings settings_;
  Workspace workspace_;
  Decomposition shrunk_;
  std::vector<double> scratch_;
};

/// Denoiser for a single signal.
[[nodiscard]] Result<Denoised> denoise(std::span<const double> signal,
                                       const DenoiseSettings& settings);

}  // namespace gyrocal
