#pragma once

#include <string_view>
#include <vector>

#include "compensation/rig/effects/effect.h"

namespace gyrocal::rig {

/// Name of a driver in a rig model file: t_s, t_on_s, die_c, die_rate_c_per_min,
/// chamber_minus_board_c, phase.
[[nodiscard]] std::string_view name_of(EmpiricalDriver driver);
[[nodiscard]] Result<EmpiricalDriver> driver_named(std::string_view name);

/// The driver's value at this instant; phase is t/period_s without its whole part, in [0, 1).
[[nodiscard]] double driver_value(const EmpiricalTerm& term, const Drivers& now);

/// Drift [deg/s]: straight between the knots, constant outside.
[[nodiscard]] double drift_dps(const EmpiricalTerm& term, const Drivers& now);

/// bad_input unless there are two knots or more, `at` ascends, lengths agree, all is finite, and a
/// phase has a period > 0.
[[nodiscard]] Result<void> check(const EmpiricalTerm& term);

}  // namespace gyrocal::rig
