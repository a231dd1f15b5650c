#pragma once

#include "schema/sqlite.h"

namespace gyrocal {

/// Whether two cells are equal up to a relative difference of their numbers, those inside a JSON
/// object included. For what floating point makes of the same samples on another processor.
/// @param relative  0: equal to the last bit.
[[nodiscard]] bool are_close(const Cell& a, const Cell& b, double relative);

}  // namespace gyrocal
