#include "compensation/discrepancy/dwell_spectrum.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/dwell_power.h"
#include "compensation/discrepancy/median.h"

namespace gyrocal {
namespace {

constexpr std::size_t fine = 2;  // zero padding: bins per 1/length
constexpr std::size_t lines_max = 6;

/// Power per bin from 0 to the folding frequency, scaled so that white noise of variance v has
/// mean v in every bin.
std::vector<double> periodogram(const DwellData& dwell, std::size_t n) {
  std::vector<double> power = dwell_power(dwell.residual_dps, dwell.seq, 0, n, fine * n);
  for (double& bin : power) bin /= static_cast<double>(n);
  return power;
}

/// Running median, narrow at the low end where coloured noise bends, wide above.
std::vector<double> smooth_background(const std::vector<double>& power) {
  std::vector<double> background(power.size());
  const std::size_t stride = 8;
  std::vector<std::size_t> knots;
  for (std::size_t k = 0; k < power.size(); k += stride) knots.push_back(k);
  knots.push_back(power.size() - 1);
  std::vector<double> level;
  for (const std::size_t k : knots) {
    const std::size_t half = std::clamp<std::size_t>(k / 2, 12, 150);
    const std::size_t low = k > half ? k - half : 2;
    const std::size_t high = std::min(power.size(), k + half + 1);
    level.push_back(median_of({power.begin() + static_cast<std::ptrdiff_t>(std::min(low, high - 1)),
                               power.begin() + static_cast<std::ptrdiff_t>(high)}));
  }
  for (std::size_t j = 0; j + 1 < knots.size(); ++j) {
    for (std::size_t k = knots[j]; k <= knots[j + 1]; ++k) {
      const double share =
          knots[j + 1] > knots[j]
              ? static_cast<double>(k - knots[j]) / static_cast<double>(knots[j + 1] - knots[j])
              : 0.0;
      background[k] = level[j] + share * (level[j + 1] - level[j]);
    }
  }
  return background;
}

/// Median of the mean of K unit exponentials (Wilson, Hilferty).
double median_of_gamma_mean(int k) { return std::pow(1 - 1.0 / (9.0 * k), 3); }

double correlation(std::span<const double> a, std::span<const double> b) {
  const auto n = static_cast<double>(a.size());
  double ma = 0, mb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma),
        bb += (b[i] - mb) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// Gain of a raised level over level 1 for a mean of `degrees` unit exponentials.
double excess_nats(double mean, double degrees) {
  return mean > 1 ? degrees * (mean - 1 - std::log(mean)) : 0.0;
}

}  // namespace

double folded_hz(double f_hz, double sample_rate_hz) {
  const double rest = std::abs(std::remainder(f_hz, sample_rate_hz));
  return rest;
}

DwellSpectrum dwell_spectrum(std::span<const DwellData> dwells, double sample_rate_hz) {
  DwellSpectrum spectrum;
  std::size_t n = 0;
  for (const DwellData& dwell : dwells) {
    const auto length = static_cast<std::size_t>(dwell.seq.back() - dwell.seq.front() + 1);
    n = n == 0 ? length : std::min(n, length);
  }
  n -= n % 2;
  if (dwells.empty() || n < spectrum_samples_min) return spectrum;
  spectrum.samples = static_cast<int>(n);
  spectrum.dwells = static_cast<int>(dwells.size());
  spectrum.bin_hz = sample_rate_hz / static_cast<double>(fine * n);
  for (const DwellData& dwell : dwells) {
    std::vector<double> power = periodogram(dwell, n);
    // Each dwell at its own level: how noise grows with temperature is another channel's matter.
    const double level =
        median_of({power.begin() + static_cast<std::ptrdiff_t>(power.size() / 10), power.end()}) /
        std::log(2.0);
    spectrum.density_dps2 += level / static_cast<double>(dwells.size());
    for (double& p : power) p /= level > 0 ? level : 1.0;
    spectrum.each.push_back(std::move(power));
  }
  std::vector<double> mean(spectrum.each.front().size(), 0.0);
  for (const auto& power : spectrum.each) {
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] += power[k] / static_cast<double>(spectrum.dwells);
    }
  }
  spectrum.background = smooth_background(mean);
  for (double& level : spectrum.background) level /= median_of_gamma_mean(spectrum.dwells);
  spectrum.mean = std::move(mean);
  for (std::size_t k = 0; k < spectrum.mean.size(); ++k) {
    const double level = spectrum.background[k] > 0 ? spectrum.background[k] : 1.0;
    spectrum.mean[k] /= level;
    for (auto& power : spectrum.each) power[k] /= level;
  }
  return spectrum;
}

std::vector<SpectralLine> find_lines(const DwellSpectrum& spectrum,
                                     std::span<const DwellData> dwells, double nats_min) {
  std::vector<SpectralLine> lines;
  if (spectrum.mean.empty()) return lines;
  std::vector<double> mean = spectrum.mean;
  std::vector<double> cooling;
  for (const DwellData& dwell : dwells) cooling.push_back(dwell.cooling);
  const double places = std::log(static_cast<double>(mean.size()));
  constexpr std::size_t lowest = 4;  // what the mean and slope taken off have touched
  while (lines.size() < lines_max) {
    SpectralLine best;
    std::size_t best_at = 0, best_width = 0;
    for (const std::size_t width : {1u, 5u, 11u, 25u}) {  // a line that wanders fills more bins
      const std::size_t half = width / 2;
      double sum = 0;
      for (std::size_t k = lowest; k < std::min(mean.size(), lowest + width); ++k) sum += mean[k];
      for (std::size_t k = lowest + half; k + half < mean.size(); ++k) {
        if (k > lowest + half) sum += mean[k + half] - mean[k - half - 1];
        // Neighbouring fine bins share their information: `width` bins are this many degrees.
        const double degrees = spectrum.dwells * std::max(1.0, static_cast<double>(width) / fine);
        const double nats = excess_nats(sum / static_cast<double>(width), degrees) - places - 1.0;
        if (nats > best.nats) best.nats = nats, best_at = k, best_width = width;
      }
    }
    if (best.nats < nats_min) break;
    const std::size_t reach = std::max<std::size_t>(best_width / 2, 3);
    const std::size_t low = best_at > reach ? best_at - reach : 0;
    const std::size_t high = std::min(mean.size() - 1, best_at + reach);
    const std::size_t peak = static_cast<std::size_t>(
        std::max_element(mean.begin() + static_cast<std::ptrdiff_t>(low),
                         mean.begin() + static_cast<std::ptrdiff_t>(high) + 1) -
        mean.begin());
    double power = 0;
    std::vector<double> per_dwell(spectrum.each.size(), 0.0);
    for (std::size_t k = low; k <= high; ++k) {
      power += (mean[k] - 1) * spectrum.background[k];
      for (std::size_t d = 0; d < per_dwell.size(); ++d) per_dwell[d] += spectrum.each[d][k];
    }
    best.f_hz = static_cast<double>(peak) * spectrum.bin_hz;
    best.width_hz = static_cast<double>(best_width) * spectrum.bin_hz;
    // A sine of amplitude a holds a^2 n / 4 in all fine bins together, `fine` times over.
    best.amplitude_dps = std::sqrt(std::max(0.0, power) * spectrum.density_dps2 * 4 /
                                   (static_cast<double>(fine) * spectrum.samples));
    double sum = 0, weighted = 0;
    for (const double p : per_dwell) {
      const double over = std::max(0.0, p - static_cast<double>(high - low + 1));
      sum += over, weighted += over * over;
    }
    const auto dwell_count = static_cast<double>(per_dwell.size());
    best.amplitude_when_on_dps =
        sum > 0
            ? best.amplitude_dps * std::sqrt(std::max(1.0, dwell_count * weighted / (sum * sum)))
            : best.amplitude_dps;
    best.gating = correlation(per_dwell, cooling);
    lines.push_back(best);
    const std::size_t clear = std::max<std::size_t>(reach + 4, 8);
    for (std::size_t k = best_at > clear ? best_at - clear : 0;
         k <= std::min(mean.size() - 1, best_at + clear); ++k) {
      mean[k] = 1;
    }
  }
  return lines;
}

}  // namespace gyrocal
