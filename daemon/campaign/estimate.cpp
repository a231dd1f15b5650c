#include <algorithm>

#include "daemon/campaign/campaign.h"
#include "daemon/campaign/overloaded.h"
#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {
namespace {

// Of the tables of schema version 1, indexes included; measured on a database of 150 000 samples.
constexpr double bytes_per_sample = 30;
constexpr double bytes_per_monitor_row = 66;
constexpr double bytes_fixed = 1 << 20;

Duration dwell_duration(const Plan& plan) {
  return seconds(double(plan.samples_per_dwell) / plan.sample_rate_hz);
}

/// The ramp, or the chamber if it is slower.
Duration travel_duration(const Plan& plan, Celsius from, Celsius to) {
  const auto& chamber = to > from ? plan.heating_per_minute : plan.cooling_per_minute;
  const Duration asked = ramp_duration(plan, from, to);
  if (!chamber || *chamber >= plan.ramp_per_minute) return asked;
  return seconds(to_seconds(asked) * plan.ramp_per_minute.value / chamber->value);
}

/// From air at `from` through the setpoints that follow `point`, and home.
Duration after_point(const Plan& plan, std::size_t point, Celsius from) {
  Duration total{};
  for (std::size_t i = point; i < plan.setpoints.size(); ++i) {
    total += travel_duration(plan, from, plan.setpoints[i]) + stay_duration(plan);
    from = plan.setpoints[i];
  }
  return total + travel_duration(plan, from, plan.safe);
}

}  // namespace

Duration stay_duration(const Plan& plan) {
  return seconds(std::max(plan.stability.air_window_s, plan.stability.soak_s_min)) +
         dwell_duration(plan);
}

Estimate estimate(const Plan& plan, Celsius start) {
  const Duration total = after_point(plan, 0, start);
  Estimate result;
  result.duration = total;
  result.duration_max =
      total + static_cast<int>(plan.setpoints.size()) * seconds(plan.stability.air_window_s);
  result.samples = plan.setpoints.size() * plan.boards.size() *
                   static_cast<std::uint64_t>(plan.samples_per_dwell);
  result.monitor_rows =
      plan.boards.size() * static_cast<std::uint64_t>(to_seconds(total) / monitor_interval_s);
  result.bytes =
      static_cast<std::uint64_t>(bytes_fixed + double(result.samples) * bytes_per_sample +
                                 double(result.monitor_rows) * bytes_per_monitor_row);
  return result;
}

Duration time_left(const Plan& plan, const State& state, Celsius air, Duration here) {
  const auto staying = [&](const Visit& visit, Duration whole) {
    const Celsius at = plan.setpoints[visit.point];
    return std::max(whole - here, Duration{}) + after_point(plan, visit.point + 1, at);
  };
  return std::visit(
      Overloaded{[&](const Preflight&) { return after_point(plan, 0, air); },
                 [&](const Ramping& s) { return after_point(plan, s.visit.point, air); },
                 [&](const Soaking& s) { return staying(s.visit, stay_duration(plan)); },
                 [&](const Logging& s) { return staying(s.visit, dwell_duration(plan)); },
                 [&](const Paused& s) { return after_point(plan, s.visit.point, air); },
                 [&](const Holding& s) { return after_point(plan, s.visit.point, air); },
                 [&](const Returning&) { return travel_duration(plan, air, plan.safe); },
                 [](const auto&) { return Duration{}; }},
      state);
}

}  // namespace gyrocal::campaign
