#include "daemon/report/gnuplot.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace gyrocal::report {
namespace {

constexpr int shell_found_no_program = 127;

/// A script on disk for as long as gnuplot reads it.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) {
    path_ = (std::filesystem::temp_directory_path() / "gyrocal-figure.XXXXXX").string();
    const int file = mkstemp(path_.data());
    if (file >= 0) close(file);
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~ScriptFile() { unlink(path_.c_str()); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  /// The letters of mkstemp and of a temporary folder; quoted all the same.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

Result<std::string> svg_of(const Figure& figure) {
  const ScriptFile script(gnuplot_script(figure));
  std::FILE* const pipe = popen(fmt::format("gnuplot '{}' 2>&1", script.path()).c_str(), "r");
  if (pipe == nullptr)
    return fail(Errc::storage, fmt::format("run gnuplot: {}", std::strerror(errno)));
  std::string printed;
  std::array<char, 65536> block;
  for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), pipe)) > 0;) {
    printed.append(block.data(), got);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == shell_found_no_program) {
    return fail(Errc::storage, "gnuplot, which draws the figures, is not installed",
                "apt install gnuplot-nox");
  }
  const auto begin = printed.find("<svg");
  if (status != 0 || begin == std::string::npos) {
    return fail(Errc::storage,
                fmt::format("gnuplot could not draw \"{}\": {}", figure.title, printed));
  }
  return printed.substr(begin, printed.rfind("</svg>") + std::strlen("</svg>") - begin);
}

}  // namespace gyrocal::report
