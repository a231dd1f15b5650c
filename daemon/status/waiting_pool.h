#pragma once

#include <httplib.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gyrocal::status {

/// Threads that answer clients; while all are busy the next connection is not accepted. httplib's
/// own pool takes every connection at once, and a thousand of them would use up the process's file
/// descriptors, which the campaign needs for its devices and its database.
class WaitingPool final : public httplib::TaskQueue {
 public:
  explicit WaitingPool(std::size_t threads);
  void enqueue(std::function<void()> task) override;
  void shutdown() override;

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t idle_ = 0;
  std::deque<std::function<void()>> tasks_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gyrocal::status
