#include "compensation/grey/grade.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(std::span<const double> values) {
  const double centre = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - centre) * (value - centre);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

const char* grade_of(double c, double p) {
  if (c < 0.35 && p > 0.95) return "good";
  if (c < 0.5 && p > 0.8) return "qualified";
  if (c < 0.65 && p > 0.7) return "just qualified";
  return "unqualified";
}

}  // namespace

std::optional<GreyGrade> grey_grade(std::span<const double> measured,
                                    std::span<const double> fitted) {
  GYROCAL_ASSERT(measured.size() >= 2 && measured.size() == fitted.size());
  const auto [low, high] = std::minmax_element(measured.begin(), measured.end());
  if (*low == *high) return std::nullopt;
  const double s1 = deviation(measured);
  std::vector<double> error(measured.size());
  std::transform(measured.begin(), measured.end(), fitted.begin(), error.begin(), std::minus<>());
  const double error_mean = mean(error);
  const auto small = std::count_if(
      error.begin(), error.end(), [&](double e) { return std::abs(e - error_mean) < 0.6745 * s1; });
  GreyGrade result;
  result.posterior_error_ratio = deviation(error) / s1;
  result.small_error_probability = static_cast<double>(small) / static_cast<double>(error.size());
  result.grade = grade_of(result.posterior_error_ratio, result.small_error_probability);
  return result;
}

}  // namespace gyrocal
