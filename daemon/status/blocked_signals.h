#pragma once

#include <pthread.h>
#include <signal.h>

namespace gyrocal::status {

/// Threads begun while one of these lives take no signals: those that ask for a stop shall wake the
/// campaign's loop, not a thread that serves a page.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace gyrocal::status
