#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tests/hidden_effects/hidden_case.h"

namespace hidden {

struct Listed {
  std::string name;
  std::function<Case()> make;
};

/// All cases of a set, in a fixed order. @param set  short | full.
std::vector<Listed> list_cases(const std::string& set, std::uint64_t seed);

}  // namespace hidden
