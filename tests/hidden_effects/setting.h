#pragma once
#include <string>
#include <vector>

#include "tests/hidden_effects/sensor.h"
#include "tests/hidden_effects/slow_laws.h"
#include "tests/hidden_effects/thermal.h"

namespace hidden {

/// One campaign on one board before anything is hidden in it.
struct Setting {
  Plan plan;
  Chain chain;
  Baseline baseline;
  Sensor sensor;
  std::string device;
  std::string axis;
  int samples_per_dwell;
  double monitor_interval_s;
  double flicker_share;  ///< of the weak flicker nobody should be able to see, 0..1
  int monitor_gaps;
  std::uint64_t temperature_seed;  ///< the chamber does the same however often it is simulated

  double dwell_s() const { return samples_per_dwell / sensor.rate_hz; }
  /// Noise per sample, rounding included, over the root of the rate [deg/s/sqrt(Hz)].
  double white_per_root_hz() const;
  /// Rounding beside noise: below about 0.5 the codes show as stairs.
  double sigma_over_lsb() const { return sensor.white_dps / sensor.lsb_dps; }
  Trajectory trajectory(const Chain& with) const;
};

struct Wanted {
  std::vector<std::string> plans;
  double white_dps_max = 10.0;
  double sigma_over_lsb_min = 0.45;
  int samples_per_dwell_min = 500;
  double slope_scale = 1.0;   ///< of the baseline's linear part
  bool straight = false;      ///< the baseline is a line
  bool every_column = false;  ///< nothing left out: the effect needs it
};

Setting draw_setting(const Wanted& wanted, Random& random);

}  // namespace hidden
