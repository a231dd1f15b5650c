#pragma once

#include <span>

#include "compensation/discrepancy/segments.h"
#include "compensation/discrepancy/track.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// Puts the accelerometer's means over the dwells into the track: the driver of g_sensitivity, an
/// input that may be looked at in all dwells. Between two dwells it creeps on a straight line;
/// where it changed by far more than is usual the board slipped, at an instant that only the gyro
/// can tell: the one at which a step fits the rows between best, whatever size and sign it has.
void add_acceleration(const Session& session, std::span<const Segment> segments, Track& track);

/// Whether the accelerometer moved by more than its own noise during the session.
[[nodiscard]] bool acceleration_varies(const Track& track);

}  // namespace gyrocal
