#pragma once

#include <chrono>
#include <string>

#include "daemon/runner/campaign_runner.h"

namespace gyrocal::runner {

/// "3:05:09": hours, minutes, seconds of campaign time.
[[nodiscard]] std::string clock_text(Duration t);

/// Shows a person on stderr how a campaign goes: every event as a line and, on a terminal only, one
/// line of progress with the time left below them.
class Progress {
 public:
  /// @param on_terminal  stderr is a terminal.
  explicit Progress(bool on_terminal) : on_terminal_(on_terminal) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const EventInsert& event);
  void show(const Snapshot& now);

 private:
  void clear();

  bool on_terminal_;
  bool line_shown_ = false;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace gyrocal::runner
