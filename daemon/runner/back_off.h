#pragma once

#include <algorithm>

#include "drivers/clock.h"

namespace gyrocal::runner {

/// When to try a lost device again: at once, then after `first`, doubling up to `longest`.
class BackOff {
 public:
  BackOff(Duration first, Duration longest) : first_(first), longest_(longest), wait_(first) {}

  [[nodiscard]] bool due(Duration t) const { return t >= next_; }
  void failed(Duration t) {
    next_ = t + wait_;
    wait_ = std::min(wait_ * 2, longest_);
  }
  void succeeded() {
    wait_ = first_;
    next_ = Duration::min();
  }

 private:
  Duration first_;
  Duration longest_;
  Duration wait_;
  Duration next_ = Duration::min();
};

}  // namespace gyrocal::runner
