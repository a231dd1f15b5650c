#include <cmath>

#include "daemon/campaign/plan.h"

namespace gyrocal::campaign {
namespace {

// Of the tables of schema version 1, indexes included; measured on a database of 150 000 samples.
constexpr double bytes_per_sample = 32;
constexpr double bytes_per_monitor_row = 110;
constexpr double bytes_fixed = 1 << 20;

}  // namespace

Estimate estimate(const Plan& plan, Celsius start) {
  const double dwell_s = double(plan.samples_per_dwell) / plan.sample_rate_hz;
  const double settle_s = std::max(plan.stability.air_window_s, plan.stability.soak_s_min);
  Duration total{};
  Celsius from = start;
  for (const Celsius to : plan.setpoints) {
    total += ramp_duration(plan, from, to) + seconds(settle_s + dwell_s);
    from = to;
  }
  total += ramp_duration(plan, from, plan.safe);
  Estimate result;
  result.duration = total;
  result.samples = plan.setpoints.size() * plan.boards.size() *
                   static_cast<std::uint64_t>(plan.samples_per_dwell);
  result.monitor_rows =
      plan.boards.size() * static_cast<std::uint64_t>(to_seconds(total) / monitor_interval_s);
  result.bytes =
      static_cast<std::uint64_t>(bytes_fixed + double(result.samples) * bytes_per_sample +
                                 double(result.monitor_rows) * bytes_per_monitor_row);
  return result;
}

}  // namespace gyrocal::campaign
