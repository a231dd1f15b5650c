#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hidden {

struct Ran {
  std::string trouble;  ///< not started, stopped by us or by a signal, exit code; empty = exit 0
  std::string output;   ///< its stdout
  double seconds = 0.0;
};

/// Runs a program to its end with stdout into `output_file`; stderr passes through to
/// `output_file`.err. Stopped after `limit_s`.
Ran run_program(const std::vector<std::string>& words, const std::filesystem::path& output_file,
                double limit_s);

std::string read_file(const std::filesystem::path& file);

}  // namespace hidden
