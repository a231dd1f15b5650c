#pragma once

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// The score that the best of all laws of the catalogue exceeds in one of a hundred sessions of
/// this plan and this noise in which nothing is hidden [nat]. A hundred residuals are drawn,
/// scanned as the session's own is, and the tail of their maxima is continued as an exponential;
/// what refining a shape adds to a scan is put on top. The same session always gives the same
/// number. Source: discrepancy_methods.md section 2, step 4.
[[nodiscard]] double null_gate_nats(const SlowModel& model);

}  // namespace gyrocal
