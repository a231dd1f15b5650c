#pragma once

#include <span>
#include <vector>

#include "compensation/values/records.h"

namespace gyrocal {

/// Ramp, soak and dwell of one setpoint: from the end of the dwell before to the end of its own.
struct Segment {
  int dwell = 0;  ///< Session::dwells[].dwell
  double begin_s = 0;
  double end_s = 0;
  double dwell_begin_s = 0;
  double dwell_end_s = 0;
  bool held_out = false;  ///< kept out of every fit, used once, for the gap
};

/// Every fifth segment in time order is kept out, never the first or the last; none where there
/// are fewer than four. The choice looks at the dwells' times only.
/// @param session  at least one dwell, dwells in time order.
[[nodiscard]] std::vector<Segment> split_segments(const Session& session);

/// Seconds on either side of a kept-out segment that no fit may use: what filters could carry
/// across the edge.
inline constexpr double guard_s = 600;

/// Whether a fit may use what was measured at t_s.
[[nodiscard]] bool may_train_on(std::span<const Segment> segments, double t_s);

/// Whether t_s lies inside a kept-out segment.
[[nodiscard]] bool is_held_out(std::span<const Segment> segments, double t_s);

}  // namespace gyrocal
