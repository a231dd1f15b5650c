#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "daemon/runner/campaign_runner.h"

namespace gyrocal::status {

/// From the campaign's loop to one who watches it, in another thread. The loop's side never waits:
/// while the watcher holds the lock, what the loop has to say stays with the loop until its next
/// turn. Of snapshots only the newest is kept, of events all (the oldest go beyond events_max).
class Mailbox {
 public:
  struct Content {
    std::optional<runner::Snapshot> snapshot;  ///< the newest since the last take()
    std::vector<EventInsert> events;           ///< in order
  };

  /// By the loop's thread alone.
  void put(const runner::Snapshot& now);
  void put(const EventInsert& event);

  /// By the watcher. What was there is gone from the mailbox.
  [[nodiscard]] Content take();

  static constexpr std::size_t events_max = 10000;

 private:
  void hand_over();

  Content waiting_;  ///< the loop's own
  std::mutex mutex_;
  Content handed_over_;  ///< under the lock
};

}  // namespace gyrocal::status
