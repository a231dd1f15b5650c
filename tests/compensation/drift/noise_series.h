#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gyrocal::test {

inline std::vector<double> white(std::size_t length, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, deviation);
  std::vector<double> series(length);
  for (double& x : series) x = normal(random);
  return series;
}

/// x(i) = memory x(i-1) + e(i), e of deviation 1, started in its stationary state.
inline std::vector<double> autoregressive(std::size_t length, double memory, std::mt19937& random) {
  std::vector<double> series = white(length, 1, random);
  series[0] /= std::sqrt(1 - memory * memory);
  for (std::size_t i = 1; i < length; ++i) series[i] += memory * series[i - 1];
  return series;
}

/// 1/f noise over the time scales of the series: first-order processes of variance 1 an octave
/// apart. Integrated over the octaves their spectral density is 1/(f ln 2), so the Allan variance
/// is flat at 2 ln 2 / ln 2 = 2.
inline std::vector<double> flicker(std::size_t length, std::mt19937& random) {
  std::vector<double> series(length);
  for (double time = 1; time < 4 * static_cast<double>(length); time *= 2) {
    const double memory = std::exp(-1 / time);
    const double scale = std::sqrt(1 - memory * memory);
    const std::vector<double> part = autoregressive(length, memory, random);
    for (std::size_t i = 0; i < length; ++i) series[i] += scale * part[i];
  }
  return series;
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace gyrocal::test
