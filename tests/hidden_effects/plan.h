#pragma once
#include <string>
#include <vector>

#include "tests/hidden_effects/random.h"

namespace hidden {

/// What the operator asked the chamber to do.
struct Plan {
  std::string kind;
  std::vector<double> setpoints_c;
  double start_c = 22.0;           ///< the room, where everything rests at t = 0
  double soak_s = 1200.0;          ///< after the air has arrived
  double ramp_up_c_per_min = 1.0;  ///< the chamber's limits
  double ramp_down_c_per_min = 0.7;
  bool log_return = false;  ///< the record goes on while the chamber returns to the room
};

/// @param kind  up | down | up_down | shuffled | up_revisit (four setpoints again at the end) |
///              coarse (nine setpoints, up and down) | single (one dwell) | dense (one per degree)
Plan make_plan(const std::string& kind, Random& random);

}  // namespace hidden
