#pragma once
#include <cstddef>
#include <vector>

#include "tests/hidden_effects/plan.h"
#include "tests/hidden_effects/random.h"

namespace hidden {

/// The thermal chain: chamber air -> board -> die -> (an extra lag of two equal poles), with the
/// part's own heat on top.
struct Chain {
  double board_tau_s = 240.0;
  double die_tau_s = 40.0;
  double ripple_c = 0.15;  ///< the chamber's cycling, half its swing
  double ripple_period_s = 420.0;
  double extra_lag_s = 0.0;  ///< sum of both poles; 0 = none
  double self_heat_c = 0.0;  ///< what the die ends at above its unpowered temperature
  double self_heat_s = 600.0;
  double self_heat_on_board = 0.2;  ///< share of it the board's sensor sees
};

struct Dwell {
  double setpoint_c;
  double start_s;
};

/// Everything once a second, from RK4 on the coupled equations with half-second steps.
struct Trajectory {
  std::vector<double> setpoint_c;
  std::vector<double> air_c;
  std::vector<double> board_c;         ///< what the sensor would show, own heat included
  std::vector<double> die_c;           ///< after board and die lag only
  std::vector<double> rate_c_per_min;  ///< slope of die_c
  std::vector<double> felt_c;  ///< die_c after extra lag and own heat: what the bias follows
  std::vector<char> compressor_on;
  std::vector<Dwell> dwells;
  std::size_t seconds() const { return air_c.size(); }
};

/// @param dwell_s  how long each dwell takes [s].
Trajectory simulate_temperatures(const Plan& plan, const Chain& chain, double dwell_s,
                                 Random& random);

}  // namespace hidden
