#include "compensation/discrepancy/dwell_features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "compensation/discrepancy/dwell_power.h"
#include "compensation/discrepancy/median.h"

namespace gyrocal {
namespace {

constexpr double tail_sd = 4.5;
constexpr std::ptrdiff_t lowest_bin = 3;

double anscombe(double count) { return 2 * std::sqrt(count + 0.375); }

void spectrum_features(std::span<const double> y, std::span<const std::int64_t> seq, double mean,
                       DwellFeatures& features) {
  const auto n = static_cast<std::size_t>(seq.back() - seq.front() + 1);
  const std::size_t length = n + n % 2;
  std::vector<double> power = dwell_power(y, seq, mean, n, length);
  power.erase(power.begin(), power.begin() + std::min(lowest_bin, std::ssize(power)));
  for (double& bin : power) bin = bin / static_cast<double>(length) + 1e-300;
  for (std::size_t band = 0; band < DwellFeatures::bands; ++band) {
    const std::size_t low = band * power.size() / DwellFeatures::bands;
    const std::size_t high = (band + 1) * power.size() / DwellFeatures::bands;
    double sum = 0;
    for (std::size_t k = low; k < high; ++k) sum += power[k];
    features.spectrum[band] =
        std::log(sum / static_cast<double>(std::max<std::size_t>(high - low, 1)));
  }
  const double peak = *std::max_element(power.begin(), power.end());
  features.spectrum[DwellFeatures::bands] = std::log(peak / median_of(std::move(power)));
}

double empty_codes(std::span<const double> y, double mean, double sd, double lsb) {
  std::map<std::int64_t, int> seen;
  for (const double value : y) ++seen[std::llround(value / lsb)];
  double empty = 0;
  // More codes than samples: then most are empty for no reason.
  if (2 * sd / lsb > static_cast<double>(y.size())) return 0;
  for (auto code = std::llround((mean - sd) / lsb); code <= std::llround((mean + sd) / lsb);
       ++code) {
    empty += !seen.contains(code);
  }
  return empty;
}

}  // namespace

DwellFeatures dwell_features(std::span<const double> y_dps, std::span<const std::int64_t> seq,
                             double lsb_dps) {
  DwellFeatures features;
  const auto n = static_cast<double>(y_dps.size());
  double mean = 0, second = 0, third = 0, fourth = 0;
  for (const double y : y_dps) mean += y / n;
  for (const double y : y_dps) {
    const double d = y - mean;
    second += d * d / n, third += d * d * d / n, fourth += d * d * d * d / n;
  }
  const double sd = std::sqrt(std::max(second, 1e-18));
  double tails = 0, longest = 1, run = 1;
  for (std::size_t i = 0; i < y_dps.size(); ++i) {
    tails += std::abs(y_dps[i] - mean) > tail_sd * sd;
    if (i == 0) continue;
    run = y_dps[i] == y_dps[i - 1] ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  features.sd_dps = sd;
  features.distribution = {std::log(sd), third / (sd * sd * sd), fourth / (second * second) - 3,
                           anscombe(tails),
                           anscombe(lsb_dps > 0 ? empty_codes(y_dps, mean, sd, lsb_dps) : 0.0)};
  const double lost = static_cast<double>(seq.back() + 1) - n;
  features.lost_share = lost / static_cast<double>(seq.back() + 1);
  features.link = {anscombe(lost), std::log(longest)};
  spectrum_features(y_dps, seq, mean, features);
  return features;
}

}  // namespace gyrocal
