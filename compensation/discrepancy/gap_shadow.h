#pragma once

#include <vector>

#include "compensation/discrepancy/track.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// Across a gap in the record the air is taken to go straight from one reading to the next. It may
/// have jumped at the gap's beginning or at its end; where those two would put the die further
/// apart than this, its temperature is not known well enough to fit a drift to [degC].
inline constexpr double gap_shadow_c = 0.03;

/// The monitor rows where that is so: after a gap during which the temperature changed, until the
/// lags have forgotten it.
/// @return indices into session.monitor, ascending.
[[nodiscard]] std::vector<std::size_t> rows_in_gap_shadow(const Session& session,
                                                          const Track& track);

}  // namespace gyrocal
