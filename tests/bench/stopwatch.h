#pragma once

#include <time.h>

#include <algorithm>
#include <limits>

namespace gyrocal::bench {

/// CPU time of this thread [s]: other work on the machine does not count.
inline double cpu_now_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least CPU time of one call [s]. Calls are timed in batches of about 2 ms for half a second,
/// at least 5 batches. python_peer.py measures the same way.
template <class Call>
double least_time_s(Call call) {
  call();
  const double begin = cpu_now_s();
  call();
  const int batch = std::max(1, static_cast<int>(2e-3 / std::max(cpu_now_s() - begin, 1e-8)));
  double least = std::numeric_limits<double>::infinity();
  const double start = cpu_now_s();
  for (int round = 0; round < 5 || cpu_now_s() - start < 0.5; ++round) {
    const double before = cpu_now_s();
    for (int i = 0; i < batch; ++i) call();
    least = std::min(least, (cpu_now_s() - before) / batch);
  }
  return least;
}

}  // namespace gyrocal::bench
