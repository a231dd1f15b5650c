#pragma once

#include <string>

#include "compensation/values/error.h"

namespace gyrocal {

/// One writer a database: an exclusive lock on PATH-writer, a file beside it that names the holder.
/// Not on the database itself: closing any descriptor of it would drop SQLite's own locks. The
/// kernel releases it with the process, however that ends.
class WriterLock {
 public:
  /// @return busy with the holder's process id; storage if the file cannot be made.
  [[nodiscard]] static Result<WriterLock> take(const std::string& database_path);

  WriterLock(WriterLock&& other) noexcept;
  WriterLock& operator=(WriterLock&& other) noexcept;
  ~WriterLock();

 private:
  WriterLock(int file, std::string path) : file_(file), path_(std::move(path)) {}
  int file_ = -1;
  std::string path_;
};

}  // namespace gyrocal
