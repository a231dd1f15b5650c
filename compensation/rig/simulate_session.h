#pragma once

#include <cstdint>

#include "compensation/rig/rig_model.h"
#include "compensation/rig/session_plan.h"
#include "compensation/values/records.h"
#include "compensation/values/units.h"

namespace gyrocal::rig {

/// Whose record is wanted.
struct SessionSubject {
  std::uint32_t board = 0;
  Axis axis = Axis::z;
};

/// A whole campaign of one board and axis in virtual time, no wire: what a session directory holds
/// (DESIGN section 6). The gyro streams from t = 0 through ramps and soaks; monitor rows are means
/// over the interval of what arrived; `seq` of a dwell's samples counts lost frames too. Same
/// model, plan, seed and subject: same session, bit for bit. `plan` and the model's effects must
/// have been checked. About 0.1 s for 10 h at 50 Hz.
[[nodiscard]] Session simulate_session(const RigModel& model, const SessionPlan& plan,
                                       std::uint64_t seed, const SessionSubject& subject = {});

}  // namespace gyrocal::rig
