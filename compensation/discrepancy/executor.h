#pragma once

#include <cstddef>
#include <functional>

namespace gyrocal {

/// Runs task(0) .. task(count - 1), each once, in any order and on any threads, and returns when
/// all are done. Who calls the numerics brings it: they start no threads themselves. Tasks write
/// only to places of their own, so that the answer is the same whoever runs them.
using Executor =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// One after the other, on the caller's thread.
inline void run_in_turn(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

}  // namespace gyrocal
