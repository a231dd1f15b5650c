#pragma once

#include <optional>
#include <string>

namespace gyrocal::status {

struct View;

/// What is wrong with a campaign, in one sentence, and what a person can do about it.
struct Concern {
  std::string severity = "info";  ///< "info": nothing; "warning": it may mend itself; "error"
  std::string sentence;
  std::string advice;  ///< empty: nothing is to be done
};

/// Setpoints given up are of concern from the second on: one may be an accident, two are a limit
/// that cannot be met, and hours lost each.
struct GivenUp {
  int setpoints = 0;  ///< among the events the view holds
  std::optional<Concern> concern;
};
[[nodiscard]] GivenUp given_up(const View& view);

/// The worst of what is known; Nothing is wrong, if nothing is.
[[nodiscard]] Concern concern_of(const View& view);

}  // namespace gyrocal::status
