#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace gyrocal::bench {

struct ChildResult {
  std::string printed;  ///< on standard output
  int exit_code = 0;    ///< -1: a signal ended it
  double cpu_s = 0;     ///< user and system time of the whole process, start and end included
  double wall_s = 0;
  double memory_bytes = 0;  ///< the most it had resident; not less than this program
};

/// Runs a program to its end, its standard error thrown away. Absent if it cannot be started.
[[nodiscard]] std::optional<ChildResult> run_child(const std::vector<std::string>& arguments);

/// Where this program's own file is.
[[nodiscard]] std::string this_program();

/// A program that runs until this goes out of scope: SIGTERM, then waited for.
class BackgroundProcess {
 public:
  explicit BackgroundProcess(const std::vector<std::string>& arguments);
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;
  ~BackgroundProcess();
  /// The next line it prints, without its end; empty once it prints no more.
  [[nodiscard]] std::string read_line();

 private:
  pid_t child_ = -1;
  int out_ = -1;
};

}  // namespace gyrocal::bench
