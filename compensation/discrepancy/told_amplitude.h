#pragma once

#include "compensation/discrepancy/slow_story.h"

namespace gyrocal {

/// The number to tell where a law's own depends on its shape: mean aging per hour over the record,
/// largest drift of a film, drift per g along the axis that tilted. 0: the law's own amplitude.
[[nodiscard]] double told_amplitude(const SlowFinding& finding, const SlowModel& model);

}  // namespace gyrocal
