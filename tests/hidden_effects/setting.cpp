#include "tests/hidden_effects/setting.h"

#include <cmath>

namespace hidden {
namespace {

struct Grade {
  double white_dps, lsb_dps;
};
// From a quiet part to the paper's raw 1.31 deg/s; LSBs from 0.05 to 0.24.
const std::vector<Grade> grades = {{0.05, 0.05}, {0.08, 0.05},  {0.1, 0.05},
                                   {0.1, 0.12},  {0.2, 0.1},    {0.3, 0.24},
                                   {0.6, 0.242}, {1.31, 0.242}, {0.05, 0.12}};

Baseline draw_baseline(const Wanted& wanted, Random& random) {
  Baseline baseline{random.chance(0.4) ? 4.1 : random.uniform(-6.0, 6.0),
                    wanted.slope_scale * random.sign() * random.uniform(0.08, 0.3),
                    random.uniform(-0.12, 0.12), random.uniform(-0.08, 0.08)};
  if (wanted.straight) baseline.square_dps = baseline.cube_dps = 0.0;
  return baseline;
}

Sensor draw_sensor(const Wanted& wanted, Random& random) {
  Sensor sensor;
  do {
    const Grade& grade = random.pick(grades);
    sensor.white_dps = grade.white_dps * random.uniform(0.9, 1.1);
    sensor.lsb_dps = grade.lsb_dps;
  } while (sensor.white_dps > wanted.white_dps_max ||
           sensor.white_dps < wanted.sigma_over_lsb_min * sensor.lsb_dps);
  sensor.rate_hz = random.pick(std::vector<double>{25.0, 47.0, 50.0, 50.0, 50.0, 100.0});
  sensor.clock_error = 1e-6 * random.uniform(-80.0, 80.0);
  sensor.board_step_c = random.pick(std::vector<double>{0.0625, 0.125, 0.125, 0.125, 0.5});
  sensor.air_step_c = random.pick(std::vector<double>{0.01, 0.01, 0.1});
  sensor.has_acceleration = wanted.every_column || random.chance(0.8);
  // Without the chamber's column a coarse board thermometer alone would hide the temperature.
  sensor.has_air = wanted.every_column || sensor.board_step_c > 0.2 || random.chance(0.95);
  return sensor;
}

}  // namespace

double Setting::white_per_root_hz() const {
  const double rounding = sensor.lsb_dps * sensor.lsb_dps / 12.0;
  return std::sqrt((sensor.white_dps * sensor.white_dps + rounding) / sensor.rate_hz);
}

Trajectory Setting::trajectory(const Chain& with) const {
  Random random(temperature_seed);
  return simulate_temperatures(plan, with, dwell_s(), random);
}

Setting draw_setting(const Wanted& wanted, Random& random) {
  Setting setting;
  setting.plan = make_plan(random.pick(wanted.plans), random);
  setting.plan.log_return = random.chance(0.3);
  setting.plan.ramp_up_c_per_min = random.uniform(0.9, 1.1);
  setting.plan.ramp_down_c_per_min = random.uniform(0.6, 0.8);
  setting.chain.board_tau_s = random.uniform(205.0, 280.0);
  // A die lag further off than this is itself a thermal_lag a shuffled plan can see.
  setting.chain.die_tau_s = random.uniform(39.0, 41.0);
  setting.chain.ripple_c = random.uniform(0.1, 0.2);
  setting.chain.ripple_period_s = random.uniform(360.0, 500.0);
  setting.baseline = draw_baseline(wanted, random);
  setting.sensor = draw_sensor(wanted, random);
  setting.device = "board-" + std::to_string(100 + random.below(900));
  setting.axis = random.pick(std::vector<std::string>{"z", "z", "x", "y"});
  do {
    setting.samples_per_dwell = random.pick(std::vector<int>{500, 1000, 1500, 2000, 3000});
  } while (setting.samples_per_dwell < wanted.samples_per_dwell_min);
  setting.monitor_interval_s = random.pick(std::vector<double>{2.0, 5.0, 5.0, 10.0, 20.0});
  setting.flicker_share = random.uniform(0.0, 1.0);
  setting.monitor_gaps = random.chance(0.35) ? 1 + static_cast<int>(random.below(3)) : 0;
  setting.temperature_seed = random.below(1'000'000'000);
  return setting;
}

}  // namespace hidden
