#include "compensation/discrepancy/dwell_power.h"

#include <complex>
#include <unsupported/Eigen/FFT>

namespace gyrocal {

std::vector<double> dwell_power(std::span<const double> y, std::span<const std::int64_t> seq,
                                double mean, std::size_t samples, std::size_t length) {
  std::vector<double> padded(length, 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const auto at = static_cast<std::size_t>(seq[i] - seq.front());
    if (at < samples) padded[at] = y[i] - mean;
  }
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> transform;
  fft.fwd(transform, padded);
  std::vector<double> power(length / 2);
  for (std::size_t k = 0; k < power.size(); ++k) power[k] = std::norm(transform[k]);
  return power;
}

}  // namespace gyrocal
