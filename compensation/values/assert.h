#pragma once

namespace gyrocal {
/// Prints the broken promise with its place to stderr and aborts. Stays on in release: a restart
/// recovers and adopts, so stopping is safe; going on with a broken invariant is not.
[[noreturn]] void promise_broken(const char* condition, const char* file, int line);
}  // namespace gyrocal

#define GYROCAL_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::gyrocal::promise_broken(#condition, __FILE__, __LINE__))
