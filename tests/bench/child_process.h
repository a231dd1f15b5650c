#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gyrocal::bench {

struct ChildResult {
  std::string printed;  ///< on standard output
  double cpu_s;         ///< user and system time of the whole process, start and end included
};

/// Runs a program, its standard error thrown away. Absent if it cannot be run or fails.
[[nodiscard]] std::optional<ChildResult> run_child(const std::vector<std::string>& arguments);

/// The first Python interpreter that runs a script with success: Debian's packages belong to
/// Debian's interpreter, which need not be the first in the path.
[[nodiscard]] std::optional<ChildResult> run_python(std::vector<std::string> script_and_arguments);

}  // namespace gyrocal::bench
