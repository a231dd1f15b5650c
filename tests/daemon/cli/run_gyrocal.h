#pragma once

#include <string>

namespace gyrocal {

struct Ran {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built gyrocal with `arguments` (words the shell splits), `input` on its standard input.
Ran run_gyrocal(const std::string& arguments, const std::string& input = {});

/// Writes a file of this test program's own temporary directory; returns its path.
std::string temporary_file(const std::string& name, const std::string& content);

}  // namespace gyrocal
