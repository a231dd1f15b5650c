#pragma once

#include <string>
#include <string_view>

namespace gyrocal::status {

/// A file of the page, built into the program: it works without internet and without its tree.
struct WebFile {
  std::string_view path;  ///< "/page.css"
  const char* type;
  std::string_view text;
};

/// @return nothing if there is none of that path.
[[nodiscard]] const WebFile* web_file(std::string_view path);

}  // namespace gyrocal::status
