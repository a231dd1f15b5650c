#include "tests/daemon/cli/run_gyrocal.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gyrocal {
namespace {

/// Gone with the program.
const std::filesystem::path& directory() {
  struct Removed {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("gyrocal_cli_test." + std::to_string(getpid()));
    Removed() { std::filesystem::create_directories(path); }
    ~Removed() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Removed removed;
  return removed.path;
}

std::string content_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

std::string temporary_file(const std::string& name, const std::string& content) {
  const auto path = directory() / name;
  std::ofstream(path, std::ios::binary) << content;
  return path.string();
}

Ran run_gyrocal(const std::string& arguments, const std::string& input) {
  const auto in = temporary_file("stdin", input);
  const auto out = directory() / "stdout";
  const auto err = directory() / "stderr";
  const std::string command = std::string(GYROCAL_PROGRAM) + " " + arguments + " < " + in + " > " +
                              out.string() + " 2> " + err.string();
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(out), content_of(err)};
}

}  // namespace gyrocal
