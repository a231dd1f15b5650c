#include "compensation/wavelet/threshold.h"

#include <algorithm>
#include <cmath>

#include "compensation/wavelet/median_magnitude.h"

namespace gyrocal {
namespace {

constexpr double normal_quartile = 0.6744897501960817;  // median |x| of a standard normal x

double bayes_threshold(std::span<const double> details, double sigma) {
  double energy = 0.0;
  double largest = 0.0;
  for (const double d : details) {
    energy += d * d;
    largest = std::max(largest, std::abs(d));
  }
  const double signal_variance = energy / static_cast<double>(details.size()) - sigma * sigma;
  return signal_variance > 0.0 ? sigma * sigma / std::sqrt(signal_variance) : largest;
}

/// Risk at threshold t: n - 2 #{|x| <= t} + sum min(x^2, t^2), in units of sigma^2. It can only be
/// least at one of the |x| or at 0.
double sure_threshold(std::span<const double> details, double sigma, std::vector<double>& scratch) {
  if (sigma == 0.0) return 0.0;
  scratch.clear();
  for (const double d : details) scratch.push_back((d / sigma) * (d / sigma));
  std::sort(scratch.begin(), scratch.end());
  const auto n = static_cast<double>(details.size());
  double least_risk = n;
  double best = 0.0;
  double below = 0.0;
  for (std::size_t k = 0; k < scratch.size(); ++k) {
    const auto kept = static_cast<double>(scratch.size() - 1 - k);
    below += scratch[k];
    const double risk = n - 2.0 * static_cast<double>(k + 1) + below + kept * scratch[k];
    if (risk < least_risk) {
      least_risk = risk;
      best = scratch[k];
    }
  }
  return sigma * std::sqrt(best);
}

double minimax_threshold(double sigma, std::size_t signal_length) {
  if (signal_length <= 32) return 0.0;
  return sigma * (0.3936 + 0.1829 * std::log2(static_cast<double>(signal_length)));
}

}  // namespace

double robust_sigma(std::span<const double> details, std::vector<double>& scratch) {
  if (details.empty()) return 0.0;
  return median_magnitude(details, scratch) / normal_quartile;
}

double threshold_of(ThresholdChoice choice, std::span<const double> details, double sigma,
                    std::size_t signal_length, std::vector<double>& scratch) {
  switch (choice) {
    case ThresholdChoice::universal:
      return sigma * std::sqrt(2.0 * std::log(static_cast<double>(signal_length)));
    case ThresholdChoice::sure:
      return sure_threshold(details, sigma, scratch);
    case ThresholdChoice::minimax:
      return minimax_threshold(sigma, signal_length);
    case ThresholdChoice::bayes:
      return bayes_threshold(details, sigma);
  }
  return 0.0;
}

void shrink(std::span<double> details, double threshold, Shrinkage shrinkage) {
  switch (shrinkage) {
    case Shrinkage::soft:
      for (double& d : details) d = std::copysign(std::max(std::abs(d) - threshold, 0.0), d);
      return;
    case Shrinkage::hard:
      for (double& d : details) d = std::abs(d) < threshold ? 0.0 : d;
      return;
    case Shrinkage::garrote:
      for (double& d : details) d = std::abs(d) <= threshold ? 0.0 : d - threshold * threshold / d;
      return;
  }
}

}  // namespace gyrocal
