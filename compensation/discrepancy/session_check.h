#pragma once

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// Refuses a session no honest verdict can be given on, naming the row and what was expected: no
/// dwells, dwells outside the record, time running backwards, duplicates, constant or infinite
/// values, a rate that contradicts the times, units that cannot be degrees per second. Nothing is
/// repaired.
[[nodiscard]] Result<void> check_session(const Session& session);

/// Refuses a session whose slow stream is too short to tell anything from.
[[nodiscard]] Result<void> check_rows(const Session& session);

}  // namespace gyrocal
