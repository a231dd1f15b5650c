#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gyrocal::bench {

/// A job done several times: the middle one, the least, the most.
struct Spread {
  double median = 0;
  double least = 0;
  double most = 0;
};

/// @param values  at least one.
[[nodiscard]] inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

[[nodiscard]] inline Spread operator*(const Spread& spread, double factor) {
  return {spread.median * factor, spread.least * factor, spread.most * factor};
}

/// Slope of log(y) over log(x) by least squares: the power of x with which y grows.
/// @param x, y  equally many, at least two different x; positive.
[[nodiscard]] inline double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double sum_x = 0;
  double sum_y = 0;
  double sum_xx = 0;
  double sum_xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_x += std::log(x[i]);
    sum_y += std::log(y[i]);
    sum_xx += std::log(x[i]) * std::log(x[i]);
    sum_xy += std::log(x[i]) * std::log(y[i]);
  }
  return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

[[nodiscard]] inline double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time of this thread [s]: other work on the machine does not count.
[[nodiscard]] inline double cpu_now_s() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }
[[nodiscard]] inline double wall_now_s() { return seconds_of(CLOCK_MONOTONIC); }

/// CPU time of one call [s]. Calls are timed in batches of about 2 ms for half a second, at least 5
/// batches. peer_clock.py measures the same way.
template <class Call>
[[nodiscard]] Spread time_of_call_s(Call call) {
  call();
  const double begin = cpu_now_s();
  call();
  const int batch = std::max(1, static_cast<int>(2e-3 / std::max(cpu_now_s() - begin, 1e-8)));
  std::vector<double> times;
  const double start = cpu_now_s();
  while (times.size() < 5 || cpu_now_s() - start < 0.5) {
    const double before = cpu_now_s();
    for (int i = 0; i < batch; ++i) call();
    times.push_back((cpu_now_s() - before) / batch);
  }
  return spread_of(std::move(times));
}

/// CPU time of one call [s], called `times` times.
template <class Call>
[[nodiscard]] Spread cpu_of_runs_s(int times, Call call) {
  std::vector<double> taken;
  for (int i = 0; i < times; ++i) {
    const double before = cpu_now_s();
    call();
    taken.push_back(cpu_now_s() - before);
  }
  return spread_of(std::move(taken));
}

}  // namespace gyrocal::bench
