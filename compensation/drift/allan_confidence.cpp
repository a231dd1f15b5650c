#include "compensation/drift/allan_confidence.h"

#include <algorithm>
#include <cmath>

#include "compensation/values/assert.h"
#include "compensation/values/log_gamma.h"

namespace gyrocal {
namespace {

/// Regularised lower incomplete gamma function P(a, x): its series for x < a + 1, the continued
/// fraction of 1 - P by Lentz beyond (DLMF 8.7.1, 8.9.2).
double lower_gamma(double a, double x) {
  constexpr int most = 10000;
  constexpr double enough = 1e-15;
  const double front = std::exp(a * std::log(x) - x - log_gamma(a));
  if (x < a + 1) {
    double term = 1 / a;
    double sum = term;
    for (int k = 1; k < most && term > enough * sum; ++k) {
      term *= x / (a + k);
      sum += term;
    }
    return front * sum;
  }
  constexpr double tiny = 1e-300;
  double b = x + 1 - a;
  double c = 1 / tiny;
  double d = 1 / b;
  double fraction = d;
  for (int k = 1; k < most; ++k) {
    const double factor = -k * (k - a);
    b += 2;
    d = 1 / (factor * d + b);
    c = b + factor / c;
    fraction *= c * d;
    if (std::abs(c * d - 1) < enough) break;
  }
  return 1 - front * fraction;
}

}  // namespace

RateNoise noise_of_slope(double variance_slope) {
  if (variance_slope < -0.5) return RateNoise::white;
  return variance_slope < 0.5 ? RateNoise::flicker : RateNoise::random_walk;
}

double allan_degrees_of_freedom(std::size_t samples, std::size_t averaged, RateNoise noise) {
  const auto n = static_cast<double>(samples + 1);
  const auto m = static_cast<double>(averaged);
  double freedom = 1;
  switch (noise) {
    case RateNoise::white:
      freedom = (3 * (n - 1) / (2 * m) - 2 * (n - 2) / n) * 4 * m * m / (4 * m * m + 5);
      break;
    case RateNoise::flicker:
      freedom = averaged == 1 ? 2 * (n - 2) * (n - 2) / (2.3 * n - 4.9)
                              : 5 * n * n / (4 * m * (n + 3 * m));
      break;
    case RateNoise::random_walk:
      if (n > 3) {
        freedom =
            (n - 2) / m * ((n - 1) * (n - 1) - 3 * m * (n - 1) + 4 * m * m) / ((n - 3) * (n - 3));
      }
      break;
  }
  return std::max(freedom, 1.0);
}

double chi_squared_quantile(double degrees_of_freedom, double probability) {
  GYROCAL_ASSERT(degrees_of_freedom > 0 && probability > 0 && probability < 1);
  const double a = degrees_of_freedom / 2;
  double low = -700;  // of log(x / 2)
  double high = std::log(a + 40 + 20 * std::sqrt(a));
  double at = std::log(a);
  for (int step = 0; step < 80 && high - low > 1e-13; ++step) {
    const double x = std::exp(at);
    const double excess = lower_gamma(a, x) - probability;
    (excess < 0 ? low : high) = at;
    const double slope = std::exp(a * at - x - log_gamma(a));
    const double newton = at - excess / slope;
    // Newton while it stays within what is known, else halves.
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (std::abs(next - at) < 1e-14 * (1 + std::abs(at))) break;
    at = next;
  }
  return 2 * std::exp(at);
}

}  // namespace gyrocal
