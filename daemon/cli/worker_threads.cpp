#include "daemon/cli/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace gyrocal::cli {

Executor worker_threads(int jobs) {
  if (jobs <= 1) return run_in_turn;
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next++; i < count; i = next++) task(i);
    };
    const auto helpers = std::min(static_cast<std::size_t>(jobs), count);
    std::vector<std::thread> threads;
    for (std::size_t k = 1; k < helpers; ++k) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
  };
}

}  // namespace gyrocal::cli
