#include "daemon/campaign/supervisor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gyrocal::campaign {
namespace {

constexpr Kelvin limit_margin{5};
constexpr Kelvin way_margin{5};
constexpr Kelvin setpoint_tolerance{0.15};  ///< panels round to 0.1
constexpr Kelvin far_from_setpoint{3};
constexpr int foreign_readings_before_trip = 2;
constexpr Duration off_its_way_for = std::chrono::minutes{10};
constexpr Duration stuck_for = std::chrono::minutes{10};

bool differ(Celsius a, Celsius b, Kelvin tolerance) {
  return std::abs((a - b).value) > tolerance.value;
}

std::optional<std::string> not_ours(const ChamberReading& reading,
                                    std::optional<Celsius> commanded) {
  if (!commanded) return std::nullopt;
  if (differ(reading.setpoint, *commanded, setpoint_tolerance)) {
    return fmt::format("the chamber's setpoint is {:.1f} degC, {:.1f} was written",
                       reading.setpoint.value, commanded->value);
  }
  if (reading.run && *reading.run != ChamberRun::running) {
    return "the chamber has been stopped or paused";
  }
  if (reading.constant_mode == false) return "a program runs on the chamber";
  return std::nullopt;
}

}  // namespace

void Supervisor::sent_to(Celsius target) {
  from_ = air_;
  target_ = target;
  off_since_.reset();
}

std::optional<Trip> Supervisor::look(Duration t, const ChamberReading& reading,
                                     std::optional<Celsius> commanded) {
  auto trip = beyond_limits(reading.actual);
  if (!trip) trip = foreign_hand(reading, commanded);
  if (!trip) trip = stuck(t, reading);
  air_ = reading.actual;
  if (!trip) trip = off_its_way(t, reading.actual);
  return trip;
}

std::optional<Trip> Supervisor::beyond_limits(Celsius air) const {
  if (air <= allowed_.max + limit_margin && air >= allowed_.min - limit_margin) return std::nullopt;
  return Trip{
      fmt::format("the air is at {:.1f} degC, beyond what boards and chamber allow ({:.1f} "
                  "to {:.1f} degC)",
                  air.value, allowed_.min.value, allowed_.max.value)};
}

std::optional<Trip> Supervisor::foreign_hand(const ChamberReading& reading,
                                             std::optional<Celsius> commanded) {
  const auto why = not_ours(reading, commanded);
  foreign_readings_ = why ? foreign_readings_ + 1 : 0;
  if (foreign_readings_ < foreign_readings_before_trip) return std::nullopt;
  return Trip{"somebody else commands the chamber: " + *why, true};
}

std::optional<Trip> Supervisor::off_its_way(Duration t, Celsius air) {
  if (!target_) return std::nullopt;
  if (!from_) from_ = air;
  const Celsius low = std::min(*from_, *target_) - way_margin;
  const Celsius high = std::max(*from_, *target_) + way_margin;
  if (air >= low && air <= high) {
    off_since_.reset();
    if (!differ(air, *target_, way_margin)) from_ = target_;  // arrived: falling back is off, too
    return std::nullopt;
  }
  if (!off_since_) off_since_ = t;
  if (t - *off_since_ <= off_its_way_for) return std::nullopt;
  return Trip{
      fmt::format("the air is at {:.1f} degC for more than {:.0f} min, off its way from "
                  "{:.1f} to {:.1f} degC",
                  air.value, to_seconds(off_its_way_for) / 60, from_->value, target_->value)};
}

std::optional<Trip> Supervisor::stuck(Duration t, const ChamberReading& reading) {
  const bool same = air_ == reading.actual;
  if (!same || !differ(reading.actual, reading.setpoint, far_from_setpoint)) {
    same_since_.reset();
    return std::nullopt;
  }
  if (!same_since_) same_since_ = t;
  if (t - *same_since_ <= stuck_for) return std::nullopt;
  return Trip{
      fmt::format("the chamber has read {:.2f} degC to the last bit for more than {:.0f} "
                  "min, {:.1f} K from its setpoint",
                  reading.actual.value, to_seconds(stuck_for) / 60,
                  std::abs((reading.actual - reading.setpoint).value))};
}

}  // namespace gyrocal::campaign
