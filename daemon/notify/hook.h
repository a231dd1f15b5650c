#pragma once

#include <chrono>
#include <string>

#include "compensation/values/error.h"

namespace gyrocal::notify {

/// What a hook is called with.
struct HookCall {
  std::string program;  ///< run as it is: no shell, no arguments
  std::string input;    ///< on its standard input
  std::string kind;     ///< in its environment: GYROCAL_KIND
  std::string subject;  ///< GYROCAL_SUBJECT
  std::chrono::milliseconds within{};
};

/// Runs a program to its end and waits for it. It inherits no descriptor of ours, no blocked or
/// ignored signal, and no NOTIFY_SOCKET; when its time is over it and its process group are killed.
/// @return storage: it cannot be started; timeout: it was killed; refused: it failed, with its exit
///   code and the end of what it wrote.
[[nodiscard]] Result<void> run_hook(const HookCall& call);

}  // namespace gyrocal::notify
