#pragma once

namespace gyrocal::runner {

/// While one of these lives, SIGTERM, SIGINT and SIGHUP (a closed terminal) ask for a stop instead
/// of ending the process. A second SIGINT ends it: a person who presses twice means it.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  [[nodiscard]] static bool asked();
};

}  // namespace gyrocal::runner
