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

/// Drift [deg/s], 0 for a term of the noise: straight between the knots, constant outside.
[[nodiscard]] double drift_dps(const EmpiricalTerm& term, const Drivers& now);

/// What the white noise is multiplied by, 1 for a drift: between the knots and outside as above.
[[nodiscard]] double noise_factor(const EmpiricalTerm& term, const Drivers& now);

/// A phase that turns faster than the slow stream shows: felt by each sample, not by the drift.
[[nodiscard]] bool is_line(const EmpiricalTerm& term);

/// bad_input unless there are two knots or more, `at` ascends, there is either dps or noise_factor,
/// lengths agree, all is finite, no factor is negative, and a phase has a period > 0.
[[nodiscard]] Result<void> check(const EmpiricalTerm& term);

}  // namespace gyrocal::rig
