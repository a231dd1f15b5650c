#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compensation/rig/chamber_air.h"
#include "compensation/rig/rig_model.h"
#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal::rig {

/// The paper's 25 setpoints, -10..50 degC.
[[nodiscard]] std::vector<double> paper_setpoints_c();

enum class Sweep { up, up_down, shuffled };

/// A campaign in virtual time, as far as physics cares.
struct SessionPlan {
  std::vector<double> setpoints_c = paper_setpoints_c();
  Sweep sweep = Sweep::up;         ///< up_down visits the last one once; shuffled by the seed
  std::vector<double> revisits_c;  ///< setpoints appended at the end
  double soak_s = 1200.0;          ///< from arrival in the air band to the dwell
  int samples_per_dwell = 3000;
  double sample_rate_hz = 50.0;
  double monitor_interval_s = 5.0;
  /// Before which visit (0-based, counting revisits) the board's power is cycled.
  std::optional<int> power_cycle_before;
};

/// out_of_range, not_finite or too_few_points, naming the number and what is allowed.
[[nodiscard]] Result<void> check(const SessionPlan& plan);

struct PlannedDwell {
  double setpoint_c;
  double t_start_s;
};

/// The plan worked out: what the chamber is told, when dwells begin, when all ends.
struct Schedule {
  ChamberAir air;
  std::vector<PlannedDwell> dwells;
  std::optional<double> power_cycle_s;
  double end_s;
};
/// The chamber starts at ambient and running to the first setpoint at t = 0. A dwell begins soak_s
/// after the air has come within 0.1 degC (and its limit cycle) of the setpoint; the next setpoint
/// is set when it ends.
[[nodiscard]] Schedule schedule(const SessionPlan& plan, const ChamberPhysics& physics,
                                std::uint64_t seed);

/// The order of visits.
[[nodiscard]] std::vector<double> visits_c(const SessionPlan& plan, std::uint64_t seed);

}  // namespace gyrocal::rig
