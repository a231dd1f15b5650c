#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "daemon/campaign/campaign.h"

namespace gyrocal::campaign {

/// How much longer, or shorter, setpoints take than the plan says, learnt from those visited, so
/// that the end that is promised moves to where it will be. Pure: times come from the caller.
class Pace {
 public:
  /// A setpoint is headed for at `t`, where the plan would have it all done in `planned` from now.
  /// Its later tries belong to the same visit.
  void heading_for(std::size_t point, Duration t, Duration planned);
  /// Of a visit: paused, or a device away. It says nothing of the next one.
  void stood_still(Duration lasted) { still_ += lasted; }

  /// Time to the end: what the plan says, and what its setpoints are late by. One setpoint is no
  /// pace: from the second on it is the median's.
  /// @param planned  the plan's time to the end now.  @param after  setpoints after the present
  /// one.
  [[nodiscard]] Duration left(Duration t, Duration planned, std::size_t after) const;

 private:
  struct Visiting {
    std::size_t point;
    Duration since;
    Duration planned;
  };
  /// Of the present visit, so far.
  [[nodiscard]] Duration late_by(Duration t, Duration planned) const;

  std::optional<Visiting> visiting_;
  Duration still_{};
  std::vector<Duration> late_;  ///< each visit's
};

}  // namespace gyrocal::campaign
