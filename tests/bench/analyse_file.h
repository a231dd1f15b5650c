#pragma once

#include <string>

namespace gyrocal::bench {

/// What `gyrocal_bench --analyse FILE` does: analyses the file's first campaign, as a daemon that
/// is left with nothing but that to do. @return its exit code.
[[nodiscard]] int analyse_file(const std::string& path);

}  // namespace gyrocal::bench
