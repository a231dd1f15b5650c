#pragma once

#include <vector>

#include "compensation/discrepancy/diagnosis.h"
#include "compensation/discrepancy/dwell_codes.h"
#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// The first finding of that effect, or the end.
[[nodiscard]] std::vector<Finding>::iterator among(std::vector<Finding>& findings,
                                                   const char* effect);

/// One cause seen in the slow stream and in the samples is one finding: a self-warmed board's
/// sensor, the bends of codes, harmonics of one grid, a telegraph seen twice, a compressor's line
/// and step.
/// @param bends  whether the converter's codes moved the means that `slow` was told from.
void settle_between_channels(std::vector<Finding>& slow, std::vector<Finding>& fast,
                             const CodeFindings& codes, double lsb_dps, bool bends);

/// Whether flicker in both channels tells more than a walk in the slow stream beside a telegraph in
/// the samples, whose slow side would pass for flicker.
/// @param slow  with all that was found in it.
/// @param flicker_lead_nats  of the telegraph over flicker, on the samples alone.
[[nodiscard]] bool is_flicker_throughout(const SlowModel& slow, double flicker_lead_nats);

}  // namespace gyrocal
