#pragma once

#include <chrono>
#include <string>

#include "daemon/runner/campaign_runner.h"

namespace gyrocal::runner {

/// Tells systemd how a campaign goes (sd_notify); does nothing outside a unit. The watchdog is fed
/// only while the chamber's readings are fresh: a daemon that has lost sight of the chamber shall
/// be killed, so that ExecStopPost makes the chamber safe.
class ServiceNotifier {
 public:
  /// @param fresh_within  a reading of the chamber older than this is none.
  explicit ServiceNotifier(Duration fresh_within) : fresh_within_(fresh_within) {}

  void show(const Snapshot& now);
  /// A stop has been asked for; bringing the chamber to safety takes up to this long.
  void stopping(std::chrono::seconds up_to);

 private:
  Duration fresh_within_;
  bool ready_ = false;
  std::string status_;
  std::chrono::steady_clock::time_point next_feed_{};
};

}  // namespace gyrocal::runner
