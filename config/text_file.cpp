#include "config/text_file.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace gyrocal {

Result<std::string> read_text_file(const std::string& path) {
  const auto failed = [&path](int code) {
    const bool wrong_path = code == ENOENT || code == ENOTDIR || code == EISDIR;
    return fail(wrong_path ? Errc::bad_input : Errc::storage,
                fmt::format("read {}: {}", path, std::strerror(code)),
                code == ENOENT ? "check the path" : "");
  };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file{std::fopen(path.c_str(), "rbe")};
  if (!file) return failed(errno);
  struct stat status {};
  if (::fstat(::fileno(file.get()), &status) != 0) return failed(errno);
  if (S_ISDIR(status.st_mode)) return failed(EISDIR);

  std::string text;
  text.resize(status.st_size > 0 ? static_cast<std::size_t>(status.st_size) + 1 : 65536);
  std::size_t used = 0;
  for (;;) {  // pipes tell no size: read until nothing comes
    errno = 0;
    const std::size_t got = std::fread(text.data() + used, 1, text.size() - used, file.get());
    used += got;
    if (std::ferror(file.get()) != 0) return failed(errno != 0 ? errno : EIO);
    if (used < text.size()) break;
    text.resize(text.size() * 2);
  }
  text.resize(used);
  return text;
}

}  // namespace gyrocal
