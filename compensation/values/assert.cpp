#include "compensation/values/assert.h"

#include <cstdio>
#include <cstdlib>

namespace gyrocal {
void promise_broken(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "gyrocal: broken promise: %s at %s:%d\n", condition, file, line);
  std::abort();
}
}  // namespace gyrocal
