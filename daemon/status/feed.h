#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "daemon/status/view.h"

namespace gyrocal::status {

/// The newest view, for any number of readers in other threads than its writer's.
class Feed {
 public:
  explicit Feed(View first) : latest_(std::make_shared<const View>(std::move(first))) {}

  void publish(const View& view);
  [[nodiscard]] std::shared_ptr<const View> latest() const;
  /// Waits for a view newer than `version`. @return the newest, whatever it is, once `patience` is
  ///   over; nothing after close(), once the last has been seen.
  [[nodiscard]] std::shared_ptr<const View> newer_than(std::uint64_t version,
                                                       std::chrono::milliseconds patience) const;
  /// Nobody waits any more.
  void close();

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::shared_ptr<const View> latest_;
  bool closed_ = false;
};

}  // namespace gyrocal::status
