#include "compensation/drift/index_axis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gyrocal {

Result<IndexAxis> index_axis(std::vector<double> setpoints_c) {
  if (setpoints_c.size() < 2) {
    return fail(
        Errc::too_few_points,
        fmt::format("a temperature axis needs at least 2 setpoints, got {}", setpoints_c.size()),
        "measure more setpoints");
  }
  for (std::size_t i = 0; i < setpoints_c.size(); ++i) {
    if (!std::isfinite(setpoints_c[i])) {
      return fail(Errc::not_finite, fmt::format("setpoint {} is {} degC", i + 1, setpoints_c[i]),
                  "every setpoint is a finite temperature");
    }
    if (i > 0 && setpoints_c[i] <= setpoints_c[i - 1]) {
      return fail(Errc::out_of_range,
                  fmt::format("setpoint {} ({} degC) does not lie above setpoint {} ({} degC)",
                              i + 1, setpoints_c[i], i, setpoints_c[i - 1]),
                  "give the setpoints in strictly rising order, each once");
    }
  }
  return IndexAxis{std::move(setpoints_c)};
}

double index_at(const IndexAxis& axis, Celsius temperature) {
  const auto& list = axis.setpoints_c;
  const auto above = std::upper_bound(list.begin() + 1, list.end() - 1, temperature.value);
  const auto lower = above - 1;
  return static_cast<double>(lower - list.begin() + 1) +
         (temperature.value - *lower) / (*above - *lower);
}

Celsius temperature_at(const IndexAxis& axis, double k) {
  const auto& list = axis.setpoints_c;
  const double last_step = static_cast<double>(list.size() - 2);
  const auto lower = static_cast<std::size_t>(std::clamp(std::floor(k - 1), 0.0, last_step));
  const double fraction = k - 1 - static_cast<double>(lower);
  return {list[lower] + fraction * (list[lower + 1] - list[lower])};
}

bool covers(const IndexAxis& axis, Celsius temperature) {
  return temperature.value >= axis.setpoints_c.front() &&
         temperature.value <= axis.setpoints_c.back();
}

}  // namespace gyrocal
