#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compensation/values/records.h"

namespace gyrocal {

/// The gyro's dwell samples cut where a dwell ends, a frame was lost (`seq` jumps) or a value is
/// missing: what overlapping_allan() takes as pieces.
/// @param dwell  only this one; absent: all.
/// @return in the order of the samples; empty if there are none.
[[nodiscard]] std::vector<std::vector<double>> unbroken_pieces(
    const std::vector<SessionSample>& samples, std::optional<int> dwell);

}  // namespace gyrocal
