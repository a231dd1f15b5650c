#pragma once

#include <filesystem>
#include <string>

#include "compensation/values/error.h"

namespace gyrocal::replay {

/// A folder of our own for as long as this lives.
class ScratchFolder {
 public:
  /// @return storage.
  [[nodiscard]] static Result<ScratchFolder> make();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();

  [[nodiscard]] std::string operator/(const std::string& name) const {
    return (path_ / name).string();
  }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace gyrocal::replay
