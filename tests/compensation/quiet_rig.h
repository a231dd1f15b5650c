#pragma once

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
/// @param drift_dps  called with t_s.
template <class Drift>
Session with_drift(Session session, const Drift& drift_dps) {
  for (MonitorRow& row : session.monitor) row.gyro_dps += drift_dps(row.t_s);
  for (SessionSample& sample : session.samples) sample.gyro_dps += drift_dps(sample.t_s);
  return session;
}

}  // namespace gyrocal
