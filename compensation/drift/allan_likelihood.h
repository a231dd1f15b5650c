#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace gyrocal {

/// An observed Allan variance at one averaging factor, and the degrees of freedom it was seen with.
struct ObservedVariance {
  double averaged;
  double variance;  ///< > 0
  double degrees_of_freedom;
};

/// The kinds of noise in a rate, each with its Allan variance at averaging factor m:
///   white 1/m   flicker 1   random walk m
///   correlated: a first-order Gauss-Markov process (AR(1)) of variance 1 and correlation time c
///   samples, f = exp(-1/c): (m - 3f - m f^2 + 4 f^(m+1) - f^(2m+1)) / (m (1-f))^2
/// Source: NIST SP 1065, section 5; Zhang 2008, Metrologia 45, 549, Eq. (19) for the last.
enum NoiseKind : std::size_t { white_noise, flicker_noise, random_walk, correlated_noise };
inline constexpr std::size_t noise_kinds = 4;
using NoiseMask = unsigned;  ///< bit k: kind k is in the model

struct NoiseModel {
  NoiseMask mask = 0;
  std::array<double, noise_kinds> amount{};  ///< >= 0, of each kind's Allan variance
  double correlation_time = 1;               ///< of the correlated noise [samples]
  double minus_log_likelihood = 0;           ///< up to a constant of the data

  [[nodiscard]] double variance_at(double averaged) const;
  /// Kinds, and the correlation time if it is used.
  [[nodiscard]] std::size_t parameters() const;
};

/// Most likely amounts of the kinds in the mask, each observation taken as chi-squared: sum of
/// f/2 (ln V + S/V) is least. Fisher scoring in the logarithms of the amounts.
/// @param held  amounts of kinds outside the mask that are added and not fitted.
[[nodiscard]] NoiseModel fit_noise(const std::vector<ObservedVariance>& observed, NoiseMask mask,
                                   double correlation_time,
                                   const std::array<double, noise_kinds>& held = {});

/// The model over all masks and correlation times with the least
/// 2 (minus log likelihood) + penalty * parameters.
/// @param longest_correlation  [samples] above 1; a longer one cannot be told from a random walk.
[[nodiscard]] NoiseModel choose_noise(const std::vector<ObservedVariance>& observed,
                                      double longest_correlation, double penalty);

/// Twice the log likelihood lost against a model that meets every observation: chi-squared with
/// (observations - parameters) degrees of freedom if the model is right.
[[nodiscard]] double deviance(const std::vector<ObservedVariance>& observed,
                              const NoiseModel& model);

/// Amounts of one kind at which twice the log likelihood, the other kinds of the model refitted,
/// has fallen by `drop`; low is 0 if it does not fall that far.
struct ProfileInterval {
  double low;
  double high;
};
[[nodiscard]] ProfileInterval profile_interval(const std::vector<ObservedVariance>& observed,
                                               const NoiseModel& best, NoiseKind kind, double drop);

}  // namespace gyrocal
