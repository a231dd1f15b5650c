#pragma once

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// Exit codes of every command (DESIGN section 3).
inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_safe_state = 3;
inline constexpr int exit_differs = 4;

/// Prints "gyrocal: what" and the advice to stderr. Returns the exit code that belongs to the
/// error: exit_bad_input for usage, configuration and input, exit_failed for the rest.
int report(const Error& error);

}  // namespace gyrocal::cli
