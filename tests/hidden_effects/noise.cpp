#include "tests/hidden_effects/noise.h"

#include <complex>
#include <numbers>
#include <utility>

namespace hidden {
namespace {

using Complex = std::complex<double>;

// Radix 2, in place; only needed because a 22 h convolution done directly takes minutes.
void transform(std::vector<Complex>& values, bool inverse) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length <<= 1) {
    const double angle = (inverse ? 2.0 : -2.0) * std::numbers::pi / static_cast<double>(length);
    std::vector<Complex> turn(length / 2);
    for (std::size_t k = 0; k < turn.size(); ++k) {
      turn[k] = std::polar(1.0, angle * static_cast<double>(k));
    }
    for (std::size_t start = 0; start < n; start += length) {
      for (std::size_t k = 0; k < length / 2; ++k) {
        const Complex even = values[start + k];
        const Complex odd = values[start + k + length / 2] * turn[k];
        values[start + k] = even + odd;
        values[start + k + length / 2] = even - odd;
      }
    }
  }
}

}  // namespace

std::vector<double> flicker_noise(std::size_t n, double b_dps, Random& random) {
  if (b_dps == 0.0 || n == 0) return std::vector<double>(n, 0.0);
  const std::size_t history = n + 16384;
  std::size_t size = 1;
  while (size < 2 * history) size <<= 1;
  std::vector<Complex> white(size);
  std::vector<Complex> filter(size);
  // White of variance v through the filter gives v/(pi f); half of B^2 makes that B^2/(2 pi f).
  const double white_dps = b_dps / std::numbers::sqrt2;
  double h = 1.0;
  for (std::size_t k = 0; k < history; ++k) {
    if (k > 0) h *= (static_cast<double>(k) - 0.5) / static_cast<double>(k);
    filter[k] = h;
    white[k] = white_dps * random.normal();
  }
  transform(white, false);
  transform(filter, false);
  for (std::size_t k = 0; k < size; ++k) white[k] *= filter[k];
  transform(white, true);
  std::vector<double> noise(n);
  for (std::size_t i = 0; i < n; ++i) {
    noise[i] = white[history - n + i].real() / static_cast<double>(size);
  }
  return noise;
}

std::vector<double> random_walk(std::size_t n, double k_dps_per_root_s, double step_s,
                                Random& random) {
  std::vector<double> walk(n, 0.0);
  if (k_dps_per_root_s == 0.0) return walk;
  const double step_dps = k_dps_per_root_s * std::sqrt(step_s);
  for (std::size_t i = 1; i < n; ++i) walk[i] = walk[i - 1] + step_dps * random.normal();
  return walk;
}

}  // namespace hidden
