#include "compensation/discrepancy/mean_law.h"

#include <algorithm>
#include <cmath>

#include "compensation/discrepancy/gaussian.h"

namespace gyrocal {
namespace {

constexpr double harmless_sd_lsb = 0.6;  // above it rounding moves a mean by < 1e-3 counts
constexpr double reach_sd = 6;
// From a rail to the mean of a rate that lies a deviation short of it: 1 + pdf(1) - Q(1). Nearer,
// what is undone depends on the noise's deviation more closely than that is known.
constexpr double mean_near_rail_sd = 1.083;
constexpr std::size_t table_max = 20'000;

double code_mean(const MeanLaw::Converter& converter, double rate_dps) {
  const double lsb = converter.lsb_dps;
  const double sd = std::max(converter.sd_dps, 1e-3 * lsb);
  const auto low = std::llround((rate_dps - reach_sd * sd) / lsb);
  const auto high = std::llround((rate_dps + reach_sd * sd) / lsb);
  const auto upto = [&](double value_dps) { return upper_tail((rate_dps - value_dps) / sd); };
  double mean = 0;
  for (auto code = low; code <= high; ++code) {
    const double at = static_cast<double>(code) * lsb;
    const double left = upto(at - lsb / 2), middle = upto(at), right = upto(at + lsb / 2);
    const bool hole =
        std::binary_search(converter.holes.begin(), converter.holes.end(), std::int64_t{code});
    const auto add = [&](double value, double share) {
      mean += share * std::clamp(value, converter.lower_dps, converter.upper_dps);
    };
    if (hole) {
      add(at - lsb, middle - left);
      add(at + lsb, right - middle);
    } else {
      add(at, right - left);
    }
  }
  return mean;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto right = std::upper_bound(x.begin(), x.end(), at);
  if (right == x.begin()) return y.front() + (at - x.front());
  if (right == x.end()) return y.back() + (at - x.back());
  const auto i = static_cast<std::size_t>(right - x.begin());
  const double share = (at - x[i - 1]) / std::max(x[i] - x[i - 1], 1e-300);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

}  // namespace

MeanLaw::MeanLaw(const Converter& converter, double low, double high) {
  const bool rails = std::isfinite(converter.lower_dps) || std::isfinite(converter.upper_dps);
  if (converter.lsb_dps <= 0) return;
  if (converter.sd_dps > harmless_sd_lsb * converter.lsb_dps && converter.holes.empty() && !rails) {
    return;
  }
  lowest_told_dps_ = converter.lower_dps + mean_near_rail_sd * converter.sd_dps;
  highest_told_dps_ = converter.upper_dps - mean_near_rail_sd * converter.sd_dps;
  const double margin = 4 * converter.sd_dps + 4 * converter.lsb_dps;
  const double step = std::max(converter.lsb_dps / 16, (high - low + 2 * margin) / table_max);
  double last = -std::numeric_limits<double>::infinity();
  for (double at = low - margin; at <= high + margin; at += step) {
    // Rounding with next to no noise has flat treads: a hint of slope makes it invertible.
    last = std::max(code_mean(converter, at), last + 1e-6 * step);
    rate_.push_back(at);
    measured_.push_back(last);
  }
}

double MeanLaw::measured(double rate_dps) const {
  return bends() ? interpolate(rate_, measured_, rate_dps) : rate_dps;
}

bool MeanLaw::is_lost(double measured_dps) const {
  return measured_dps < lowest_told_dps_ || measured_dps > highest_told_dps_;
}

double MeanLaw::rate(double measured_dps) const {
  return bends() ? interpolate(measured_, rate_, measured_dps) : measured_dps;
}

}  // namespace gyrocal
