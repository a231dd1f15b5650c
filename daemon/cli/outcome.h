#pragma once

#include "compensation/values/error.h"

namespace gyrocal::cli {

/// Exit codes of every command (DESIGN section 3).
inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_safe_state = 3;
inline constexpr int exit_differs = 4;
/// Only of `gyrocal diagnose --exit-code`, where 0 is "consistent".
inline constexpr int exit_explained = 10;
inline constexpr int exit_unexplained = 11;
inline constexpr int exit_confounded = 12;

struct ExitCode {
  int code;
  const char* meaning;  ///< a phrase for man pages and docs/exit_codes.md
};
inline constexpr ExitCode exit_codes[] = {
    {exit_done, "done"},
    {exit_failed, "failed: a device, a link, a file or a disk; the message says which"},
    {exit_bad_input, "usage, configuration or input: nothing was started"},
    {exit_safe_state, "the campaign ended in its safe state, was stopped or aborted"},
    {exit_differs, "a replay or a check differs; the first difference is printed"},
    {exit_explained, "diagnose --exit-code: explained"},
    {exit_unexplained, "diagnose --exit-code: unexplained"},
    {exit_confounded, "diagnose --exit-code: confounded"},
};

/// Prints "gyrocal: what" and the advice to stderr. Returns the exit code that belongs to the
/// error: exit_bad_input for usage, configuration and input, exit_failed for the rest.
int report(const Error& error);

}  // namespace gyrocal::cli
