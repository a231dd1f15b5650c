#pragma once

#include <string>

namespace gyrocal::status {

struct View;

/// What is wrong with a campaign, in one sentence, and what a person can do about it.
struct Concern {
  std::string severity = "info";  ///< "info": nothing; "warning": it may mend itself; "error"
  std::string sentence;
  std::string advice;  ///< empty: nothing is to be done
};

/// The worst of what is known; Nothing is wrong, if nothing is.
[[nodiscard]] Concern concern_of(const View& view);

}  // namespace gyrocal::status
