#pragma once

#include <string>

/// A folder of its own for one test, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// What the sqlite3 shell's .dump would hold: every table's rows in order, as text.
[[nodiscard]] std::string dump(const std::string& database);
/// Writes `text` to a new file.
void write_file(const std::string& path, const std::string& text);
