#include "compensation/discrepancy/dwell_shape.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

double quantile(const std::vector<double>& sorted, double p, double lsb) {
  // Counts are spread evenly over their code's width, so that a quantile moves smoothly.
  const auto n = static_cast<double>(sorted.size());
  const auto at = static_cast<std::ptrdiff_t>(std::clamp(p * n, 0.0, n - 1));
  const double value = sorted[static_cast<std::size_t>(at)];
  if (lsb == 0) return value;
  const auto range = std::equal_range(sorted.begin(), sorted.end(), value);
  const auto first = static_cast<double>(range.first - sorted.begin());
  const auto count = static_cast<double>(range.second - range.first);
  return value + lsb * ((p * n - first) / count - 0.5);
}

}  // namespace

DwellShape dwell_shape(const DwellData& dwell, double lsb) {
  std::vector<double> sorted = dwell.y_dps;
  std::sort(sorted.begin(), sorted.end());
  DwellShape shape;
  shape.median = quantile(sorted, 0.5, lsb);
  shape.below = shape.median - quantile(sorted, 0.158655, lsb);
  shape.above = quantile(sorted, 0.841345, lsb) - shape.median;
  shape.sd = (shape.below + shape.above) / 2;
  return shape;
}

double white_sd_dps(const DwellData& dwell, double lsb) {
  std::vector<double> squares;
  for (std::size_t i = 1; i < dwell.y_dps.size(); ++i) {
    if (dwell.seq[i] != dwell.seq[i - 1] + 1) continue;
    const double d = dwell.y_dps[i] - dwell.y_dps[i - 1];
    squares.push_back(d * d);
  }
  if (squares.size() < 16) return 0;
  double mean = 0;
  for (int pass = 0; pass < 3; ++pass) {
    double sum = 0, n = 0;
    for (const double s : squares) {
      if (pass > 0 && s > 36 * mean) continue;
      sum += s, n += 1;
    }
    mean = sum / n;
  }
  return std::sqrt(std::max(mean / 2 - lsb * lsb / 12, 1e-18));
}

std::int64_t code_of(double y, double lsb) { return std::llround(y / lsb); }

}  // namespace gyrocal
