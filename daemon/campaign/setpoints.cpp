#include <fmt/core.h>

#include <cmath>

#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {

Result<Celsius> commandable(const SetpointRange& allowed, Celsius to) {
  if (!std::isfinite(to.value)) {
    return fail(Errc::not_finite, fmt::format("setpoint {}: not a temperature", to.value),
                "this is a fault of the program; nothing was sent");
  }
  if (to < allowed.min || to > allowed.max) {
    return fail(Errc::out_of_range,
                fmt::format("setpoint {:.1f} degC: outside the {:.1f} to {:.1f} degC that boards "
                            "and chamber allow together",
                            to.value, allowed.min.value, allowed.max.value),
                "change the setpoint, or the limits of the board or of the chamber's profile");
  }
  return to;
}

Duration ramp_duration(const Plan& plan, Celsius from, Celsius to) {
  return seconds(std::abs((to - from).value) / plan.ramp_per_minute.value * 60);
}

}  // namespace gyrocal::campaign
