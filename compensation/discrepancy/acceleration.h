#pragma once

#include "compensation/discrepancy/slow_stream.h"
#include "compensation/discrepancy/track.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// Puts the accelerometer's means over the dwells into the track: the driver of g_sensitivity, an
/// input that may be looked at in all dwells. Between two dwells it creeps on a straight line;
/// where it changed by more than any creep the board slipped or was moved, at an instant that only
/// the gyro can tell: the one at which cubic and accelerometer together explain the stream best.
void add_acceleration(const Session& session, const SlowStream& stream, Track& track);

/// Whether the accelerometer moved by more than its own noise during the session.
[[nodiscard]] bool acceleration_varies(const Track& track);

}  // namespace gyrocal
