#include "tests/docs/fenced_blocks.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "config/text_file.h"

std::vector<FencedBlock> fenced_blocks(const std::string& page) {
  std::vector<FencedBlock> blocks;
  bool inside = false;
  int number = 0;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) {
      if (!inside) blocks.push_back({line.substr(3), "", number});
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + '\n';
    }
  }
  return blocks;
}

std::vector<std::string> pages() {
  std::vector<std::string> names{"README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(GYROCAL_SOURCE_DIR "/docs")) {
    if (entry.path().extension() == ".md") {
      names.push_back("docs/" + entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string page_text(const std::string& page) {
  return gyrocal::read_text_file(GYROCAL_SOURCE_DIR "/" + page).value();
}
