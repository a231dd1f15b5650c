#include "compensation/rig/session_plan.h"

#include <fmt/core.h>

#include <cmath>

#include "compensation/rig/random.h"
#include "compensation/values/assert.h"

namespace gyrocal::rig {
namespace {

Result<void> in_range(const char* name, double value, double low, double high) {
  if (!std::isfinite(value)) {
    return fail(Errc::not_finite, fmt::format("{}: {} is no number", name, value));
  }
  if (value < low || value > high) {
    return fail(Errc::out_of_range, fmt::format("{}: {} is out of range", name, value),
                fmt::format("allowed: {}..{}", low, high));
  }
  return {};
}

double arrival_s(const ChamberAir& air, const ChamberPhysics& physics, double from_s,
                 double setpoint_c) {
  const double band_c = 0.1 + physics.cycling_c;
  double t_s = from_s;
  while (std::abs(air.at(t_s).value - setpoint_c) > band_c) t_s += 1.0;
  return t_s;
}

}  // namespace

std::vector<double> paper_setpoints_c() {
  return {-10, -7, -5, -2, 0,  3,  5,  8,  10, 13, 15, 18, 20,
          23,  25, 28, 30, 33, 35, 38, 40, 43, 45, 48, 50};
}

Result<void> check(const SessionPlan& plan) {
  if (plan.setpoints_c.empty()) {
    return fail(Errc::too_few_points, "the plan has no setpoint", "give at least one");
  }
  for (const auto* list : {&plan.setpoints_c, &plan.revisits_c}) {
    for (const double setpoint_c : *list) {
      if (auto ok = in_range("setpoint [degC]", setpoint_c, -70.0, 150.0); !ok) return ok;
    }
  }
  if (auto ok = in_range("soak [s]", plan.soak_s, 0.0, 1e6); !ok) return ok;
  if (auto ok = in_range("samples per dwell", plan.samples_per_dwell, 1, 1e7); !ok) return ok;
  if (auto ok = in_range("sample rate [Hz]", plan.sample_rate_hz, 0.1, 1e4); !ok) return ok;
  return in_range("monitor interval [s]", plan.monitor_interval_s, 1.0 / plan.sample_rate_hz, 3600);
}

std::vector<double> visits_c(const SessionPlan& plan, std::uint64_t seed) {
  std::vector<double> visits = plan.setpoints_c;
  if (plan.sweep == Sweep::up_down && visits.size() > 1) {
    visits.insert(visits.end(), plan.setpoints_c.rbegin() + 1, plan.setpoints_c.rend());
  }
  if (plan.sweep == Sweep::shuffled) {
    RandomStream random({seed, 0, 0, plan_order});
    for (std::size_t i = visits.size(); i > 1; --i) {
      std::swap(visits[i - 1],
                visits[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    }
  }
  visits.insert(visits.end(), plan.revisits_c.begin(), plan.revisits_c.end());
  return visits;
}

Schedule schedule(const SessionPlan& plan, const ChamberPhysics& physics, std::uint64_t seed) {
  GYROCAL_ASSERT(check(plan).has_value());
  Schedule made{ChamberAir(physics), {}, std::nullopt, 0.0};
  const double dwell_s = plan.samples_per_dwell / plan.sample_rate_hz;
  for (const double setpoint_c : visits_c(plan, seed)) {
    if (plan.power_cycle_before == static_cast<int>(made.dwells.size())) {
      made.power_cycle_s = made.end_s;
    }
    made.air.run(made.end_s, Celsius{setpoint_c});
    const double start_s = arrival_s(made.air, physics, made.end_s, setpoint_c) + plan.soak_s;
    made.dwells.push_back({setpoint_c, start_s});
    made.end_s = start_s + dwell_s;
  }
  return made;
}

}  // namespace gyrocal::rig
