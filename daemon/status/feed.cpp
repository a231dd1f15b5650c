#include "daemon/status/feed.h"

namespace gyrocal::status {

void Feed::publish(const View& view) {
  auto published = std::make_shared<const View>(view);
  {
    const std::lock_guard lock(mutex_);
    latest_.swap(published);
  }
  changed_.notify_all();
}

std::shared_ptr<const View> Feed::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

std::shared_ptr<const View> Feed::newer_than(std::uint64_t version,
                                             std::chrono::milliseconds patience) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return closed_ || latest_->version > version; });
  return closed_ && latest_->version <= version ? nullptr : latest_;
}

void Feed::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

}  // namespace gyrocal::status
