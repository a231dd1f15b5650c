#include "daemon/runner/service_notifier.h"

#include <fmt/core.h>
#include <systemd/sd-daemon.h>

#include "daemon/runner/progress.h"

namespace gyrocal::runner {
namespace {

constexpr auto feed_interval = std::chrono::seconds{5};

}  // namespace

void ServiceNotifier::show(const Snapshot& now) {
  if (!ready_) sd_notify(0, "READY=1");
  ready_ = true;
  const std::string status = fmt::format("{}; {} of {} setpoints, {} left", now.text,
                                         now.setpoints_done, now.setpoints, clock_text(now.left));
  const auto wall = std::chrono::steady_clock::now();
  if (wall < next_feed_) return;
  next_feed_ = wall + feed_interval;
  if (status != status_) sd_notify(0, ("STATUS=" + status).c_str());
  status_ = status;
  if (now.chamber_age <= fresh_within_) sd_notify(0, "WATCHDOG=1");
}

void ServiceNotifier::stopping(std::chrono::seconds up_to) {
  const auto microseconds = std::chrono::microseconds(up_to).count();
  sd_notify(0, fmt::format("STOPPING=1\nSTATUS=bringing the chamber to its safe setpoint\n"
                           "EXTEND_TIMEOUT_USEC={}",
                           microseconds)
                   .c_str());
}

}  // namespace gyrocal::runner
