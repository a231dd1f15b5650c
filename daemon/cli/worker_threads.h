#pragma once

#include "compensation/discrepancy/executor.h"

namespace gyrocal::cli {

/// Shares tasks among `jobs` threads, the caller's among them; started and joined at each use.
[[nodiscard]] Executor worker_threads(int jobs);

}  // namespace gyrocal::cli
