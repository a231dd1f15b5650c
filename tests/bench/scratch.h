#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace gyrocal::bench {

/// A folder of its own, on the disk that holds temporary files; gone with it.
class Scratch {
 public:
  Scratch() {
    path_ = std::filesystem::temp_directory_path() / "gyrocal_bench.XXXXXX";
    if (mkdtemp(path_.data()) != nullptr) return;
    fmt::print(stderr, "bench: cannot make a folder like {}\n", path_);
    std::exit(1);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace gyrocal::bench
