#pragma once

#include <utility>

#include "compensation/rig/rig_model.h"
#include "compensation/rig/session_plan.h"
#include "compensation/rig/simulate_session.h"
#include "compensation/values/records.h"

namespace gyrocal {

/// The default rig with a tenth of a deg/s of noise and fine counts: small effects show.
inline rig::RigModel quiet_rig() {
  rig::RigModel model;
  model.baseline.noise_dps = 0.1;
  model.baseline.lsb_per_dps = 20;
  return model;
}

/// The paper's setpoints there and back, with short dwells.
inline rig::SessionPlan short_up_down() {
  rig::SessionPlan plan;
  plan.sweep = rig::Sweep::up_down;
  plan.samples_per_dwell = 1000;
  return plan;
}

[[nodiscard]] inline Session quiet_session(std::uint64_t seed) {
  return rig::simulate_session(quiet_rig(), short_up_down(), seed);
}

/// The session with a drift added that no effect of the catalogue makes.
/// @param drift_dps  called with t_s, board_c and chamber_c.
template <class Drift>
Session with_warm_drift(Session session, const Drift& drift_dps) {
  const auto add = [&](auto& at) { at.gyro_dps += drift_dps(at.t_s, at.board_c, at.chamber_c); };
  for (MonitorRow& row : session.monitor) add(row);
  for (SessionSample& sample : session.samples) add(sample);
  return session;
}

/// The same over time alone.
template <class Drift>
Session with_drift(Session session, const Drift& drift_dps) {
  return with_warm_drift(std::move(session),
                         [&](double t_s, double, double) { return drift_dps(t_s); });
}

}  // namespace gyrocal
