#include "config/shipped_names.h"

#include <filesystem>
#include <set>

namespace gyrocal {

std::vector<std::string> shipped_names(const std::vector<std::string>& folders,
                                       const std::string& extension) {
  namespace fs = std::filesystem;
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
      if (entry.path().extension() == extension) names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace gyrocal
