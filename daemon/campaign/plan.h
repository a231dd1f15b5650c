#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "compensation/values/units.h"
#include "config/campaign.h"
#include "drivers/clock.h"

namespace gyrocal::campaign {

/// One row of the slow stream per board covers so long [s].
inline constexpr double monitor_interval_s = 5;

/// What a campaign will do, in the words of those who decide: checked numbers, no addresses.
struct Plan {
  std::vector<Celsius> setpoints;  ///< in order of visit; every one inside `allowed`
  SetpointRange allowed{};         ///< boards ∩ chamber: no setpoint outside it is ever sent
  Celsius safe{25};                ///< where every ending leaves the chamber; inside `allowed`
  Kelvin ramp_per_minute{1.0};
  std::optional<Kelvin> heating_per_minute;  ///< what the chamber can, if known
  std::optional<Kelvin> cooling_per_minute;
  int samples_per_dwell = 3000;
  int sample_rate_hz = 50;
  StabilityConfig stability;
  LimitConfig limits;
  Duration poll_interval{};         ///< of the chamber
  std::vector<std::string> boards;  ///< names, in the order of the campaign file
};

/// @return out_of_range or not_finite if a setpoint, or the safe one, lies outside what boards and
///   chamber allow, naming the value and the range.
[[nodiscard]] Result<Plan> make_plan(const CampaignConfig& config);

/// `to` if the chamber may be sent there. @return not_finite, out_of_range.
[[nodiscard]] Result<Celsius> commandable(const SetpointRange& allowed, Celsius to);

/// The time the software ramp needs between two temperatures.
[[nodiscard]] Duration ramp_duration(const Plan& plan, Celsius from, Celsius to);

/// One soak and one dwell, undisturbed.
[[nodiscard]] Duration stay_duration(const Plan& plan);

/// What a whole campaign takes, from air at `start`, if nothing is disturbed: the ramps as fast as
/// asked, or as the chamber can; at most another air window at each setpoint, until the window
/// falls well on the chamber's own cycling.
struct Estimate {
  Duration duration{};
  Duration duration_max{};
  std::uint64_t samples = 0;       ///< of all boards
  std::uint64_t monitor_rows = 0;  ///< of all boards
  std::uint64_t bytes = 0;         ///< of the database
};
[[nodiscard]] Estimate estimate(const Plan& plan, Celsius start);

}  // namespace gyrocal::campaign
