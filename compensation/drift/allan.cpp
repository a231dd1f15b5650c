#include "compensation/drift/allan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compensation/drift/allan_confidence.h"
#include "compensation/values/records.h"

namespace gyrocal {
namespace {

Result<void> check_finite(std::span<const double> rate) {
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (std::isfinite(rate[i])) continue;
    return fail(Errc::not_finite, fmt::format("sample {} of {} is {}", i, rate.size(), rate[i]),
                "cut the series at samples that are no numbers (the first sample is 0)");
  }
  return {};
}

Result<void> check(RatePieces pieces, double sample_rate_hz, std::span<const std::size_t> factors) {
  if (!(sample_rate_hz > 0) || !std::isfinite(sample_rate_hz)) {
    return fail(Errc::out_of_range, fmt::format("a sample rate of {} Hz", sample_rate_hz),
                "expected a positive number");
  }
  const std::size_t longest = longest_of(pieces);
  if (longest < 2) {
    return fail(Errc::too_few_points, fmt::format("an Allan deviation of {} samples", longest),
                "expected at least 2, better some thousand");
  }
  for (const auto piece : pieces) {
    if (const auto finite = check_finite(piece); !finite) return finite;
  }
  for (const std::size_t m : factors) {
    if (m >= 1 && 2 * m <= longest) continue;
    return fail(Errc::out_of_range, fmt::format("averaging factor {}", m),
                fmt::format("expected 1 to {}", longest / 2));
  }
  return {};
}

/// s(0) = 0, s(j) = rate(0) + ... + rate(j-1). The mean goes out first: it drops out of second
/// differences and would only cost digits.
std::vector<double> running_sum(std::span<const double> rate) {
  double mean = 0;
  for (const double value : rate) mean += value;
  mean /= static_cast<double>(rate.size());
  std::vector<double> sum(rate.size() + 1);
  for (std::size_t j = 0; j < rate.size(); ++j) sum[j + 1] = sum[j] + (rate[j] - mean);
  return sum;
}

double allan_variance(const std::vector<std::vector<double>>& sums, std::size_t m) {
  double squares = 0;
  std::size_t terms = 0;
  for (const std::vector<double>& sum : sums) {
    if (sum.size() < 2 * m + 1) continue;
    const std::size_t here = sum.size() - 2 * m;
    for (std::size_t j = 0; j < here; ++j) {
      const double second = sum[j + 2 * m] - 2 * sum[j + m] + sum[j];
      squares += second * second;
    }
    terms += here;
  }
  const auto averaged = static_cast<double>(m);
  return squares / (2 * averaged * averaged * static_cast<double>(terms));
}

/// d log(variance) / d log(m) between the neighbours of point i.
double slope_at(std::span<const AllanPoint> points, std::size_t i) {
  const AllanPoint& before = points[i == 0 ? 0 : i - 1];
  const AllanPoint& after = points[std::min(i + 1, points.size() - 1)];
  if (before.averaged == after.averaged || before.deviation == 0 || after.deviation == 0) return -1;
  return 2 * std::log(after.deviation / before.deviation) / std::log(after.tau_s / before.tau_s);
}

void add_degrees_of_freedom(RatePieces pieces, std::vector<AllanPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    AllanPoint& point = points[i];
    const RateNoise noise = noise_of_slope(slope_at(points, i));
    double freedom = 0;
    for (const auto piece : pieces) {
      if (piece.size() < 2 * point.averaged) continue;
      freedom += allan_degrees_of_freedom(piece.size(), point.averaged, noise);
    }
    point.degrees_of_freedom = freedom;
  }
}

void add_intervals(std::vector<AllanPoint>& points) {
  constexpr double tail = 0.025;
  for (AllanPoint& point : points) {
    const double freedom = point.degrees_of_freedom;
    point.deviation_low =
        point.deviation * std::sqrt(freedom / chi_squared_quantile(freedom, 1 - tail));
    point.deviation_high =
        point.deviation * std::sqrt(freedom / chi_squared_quantile(freedom, tail));
  }
}

}  // namespace

std::vector<std::size_t> allan_factors(std::size_t samples, int per_decade) {
  std::vector<std::size_t> factors;
  for (int step = 0;; ++step) {
    const double factor = std::round(std::pow(10.0, static_cast<double>(step) / per_decade));
    if (factor > static_cast<double>(samples / 2)) return factors;
    const auto m = static_cast<std::size_t>(factor);
    if (factors.empty() || factors.back() < m) factors.push_back(m);
  }
}

std::size_t longest_of(RatePieces pieces) {
  std::size_t longest = 0;
  for (const auto piece : pieces) longest = std::max(longest, piece.size());
  return longest;
}

Result<std::vector<AllanPoint>> allan_without_intervals(RatePieces pieces, double sample_rate_hz,
                                                        std::span<const std::size_t> factors) {
  if (const auto good = check(pieces, sample_rate_hz, factors); !good) {
    return tl::unexpected(good.error());
  }
  std::vector<std::vector<double>> sums;
  for (const auto piece : pieces) {
    if (piece.size() >= 2) sums.push_back(running_sum(piece));
  }
  std::vector<AllanPoint> points;
  for (const std::size_t m : factors) {
    points.push_back({.averaged = m,
                      .tau_s = static_cast<double>(m) / sample_rate_hz,
                      .deviation = std::sqrt(allan_variance(sums, m)),
                      .deviation_low = missing,
                      .deviation_high = missing,
                      .degrees_of_freedom = 0});
  }
  add_degrees_of_freedom(pieces, points);
  return points;
}

Result<std::vector<AllanPoint>> overlapping_allan(RatePieces pieces, double sample_rate_hz,
                                                  std::span<const std::size_t> factors) {
  auto points = allan_without_intervals(pieces, sample_rate_hz, factors);
  if (points) add_intervals(*points);
  return points;
}

Result<std::vector<AllanPoint>> overlapping_allan(std::span<const double> rate,
                                                  double sample_rate_hz,
                                                  std::span<const std::size_t> factors) {
  return overlapping_allan(RatePieces(&rate, 1), sample_rate_hz, factors);
}

}  // namespace gyrocal
