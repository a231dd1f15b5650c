#include "daemon/status/mailbox.h"

#include <iterator>
#include <utility>

namespace gyrocal::status {

void Mailbox::put(const runner::Snapshot& now) {
  waiting_.snapshot = now;
  hand_over();
}

void Mailbox::put(const EventInsert& event) {
  if (waiting_.events.size() < events_max) waiting_.events.push_back(event);
  hand_over();
}

void Mailbox::hand_over() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  if (waiting_.snapshot) handed_over_.snapshot = std::exchange(waiting_.snapshot, std::nullopt);
  auto& events = handed_over_.events;
  events.insert(events.end(), std::make_move_iterator(waiting_.events.begin()),
                std::make_move_iterator(waiting_.events.end()));
  waiting_.events.clear();
  if (events.size() > events_max) {
    events.erase(events.begin(), events.end() - static_cast<std::ptrdiff_t>(events_max));
  }
}

Mailbox::Content Mailbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(handed_over_, {});
}

}  // namespace gyrocal::status
