#pragma once

#include <vector>

#include "compensation/drift/methods.h"

namespace gyrocal {

/// For every setpoint the prediction of a fit that lacked it and `neighbours` setpoints on each
/// side: 0 is leave-one-out, 1 leaves a block of three out. All methods are judged alike, on the
/// same points; at the ends the prediction goes one or two steps beyond what the fit saw.
/// @return n predictions; the fit's error when too few points are left.
[[nodiscard]] Result<std::vector<double>> held_out_predictions(Method method,
                                                               const DriftSeries& whole,
                                                               const MethodSettings& settings,
                                                               std::size_t neighbours);

}  // namespace gyrocal
