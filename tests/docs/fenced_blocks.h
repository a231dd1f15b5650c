#pragma once

#include <string>
#include <vector>

/// A fenced block of a Markdown page.
struct FencedBlock {
  std::string language;  ///< "sh", "console", "sql" ...
  std::string text;      ///< without the fences
  int line = 0;          ///< of the opening fence, from 1
};
[[nodiscard]] std::vector<FencedBlock> fenced_blocks(const std::string& page);

/// README.md and docs/*.md, by name, relative to the source tree.
[[nodiscard]] std::vector<std::string> pages();
[[nodiscard]] std::string page_text(const std::string& page);
