#pragma once

#include <string>
#include <utility>

#include "compensation/values/error.h"

namespace gyrocal {

/// Owns a file descriptor.
class UniqueFd {
 public:
  explicit UniqueFd(int fd = -1) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept;
  UniqueFd(const UniqueFd&) = delete;
  UniqueFd& operator=(const UniqueFd&) = delete;
  ~UniqueFd();
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// Takes a terminal device for this process alone, before anybody changes its settings: neither
/// libserialport nor libmodbus keeps a second program out. The lock lasts as long as the descriptor
/// and ends with the process, however it ends.
/// @return link_lost if it cannot be opened, busy if another process holds it (with its number and
///   name, if they can be found).
[[nodiscard]] Result<UniqueFd> lock_tty(const std::string& path);

}  // namespace gyrocal
