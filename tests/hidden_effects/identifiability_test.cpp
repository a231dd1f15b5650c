#include "tests/hidden_effects/identifiability.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/hidden_effects/setting.h"

using hidden::Random;
using hidden::Sight;

namespace {

hidden::Setting quiet(const std::string& plan, bool straight) {
  Random random(21);
  hidden::Wanted wanted;
  wanted.plans = {plan};
  hidden::Setting setting = hidden::draw_setting(wanted, random);
  setting.sensor.white_dps = 0.1;
  setting.sensor.lsb_dps = 0.05;
  setting.sensor.rate_hz = 50.0;
  setting.baseline = {4.1, -0.15, straight ? 0.0 : 0.08, straight ? 0.0 : 0.03};
  return setting;
}

hidden::Series aging(const hidden::Trajectory& over) {
  hidden::Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i)
    series[i] = 1e-3 * static_cast<double>(i) / 3600.0;
  return series;
}

hidden::Series lag(const hidden::Setting& setting, double lag_s) {
  hidden::Chain chain = setting.chain;
  chain.extra_lag_s = lag_s;
  const auto over = setting.trajectory(chain);
  hidden::Series series(over.seconds());
  for (std::size_t i = 0; i < series.size(); ++i) {
    series[i] = setting.baseline(over.felt_c[i]) - setting.baseline(over.die_c[i]);
  }
  return series;
}

double lead_of_aging_over_self_heating(const std::string& plan) {
  const auto setting = quiet(plan, false);
  const auto over = setting.trajectory(setting.chain);
  const Sight sight(over, setting.baseline, aging(over), "aging_drift", setting.white_per_root_hz(),
                    {});
  return sight.at(2.0).lead_nats.at("self_heating");  // mdps/h
}

}  // namespace

TEST_CASE("a straight bias over temperature makes lag and heating rate one effect") {
  const auto lead = [](bool straight) {
    const auto setting = quiet("up_down", straight);
    const auto over = setting.trajectory(setting.chain);
    const Sight sight(over, setting.baseline, lag(setting, 60.0), "thermal_lag",
                      setting.white_per_root_hz(), {});
    return sight.at(1.0).lead_nats.at("temperature_rate");
  };
  CHECK(lead(true) < 3.0);
  CHECK(lead(false) > 10.0);
}

TEST_CASE("no lag explains more than the bias over temperature lets it") {
  // What a heating rate does against the slope of the bias, on a line: a lag, while it is small.
  const auto setting = quiet("up_down", true);
  const auto over = setting.trajectory(setting.chain);
  const hidden::Series slope(over.rate_c_per_min.begin(), over.rate_c_per_min.end());
  const Sight sight(over, setting.baseline, slope, "temperature_rate", setting.white_per_root_hz(),
                    {});
  const auto lead = [&](double dps_per_c_per_min) {
    return sight.at(dps_per_c_per_min).lead_nats.at("thermal_lag");
  };
  const double of_15_s_dps = 0.25 * 0.15 / 30.0;  // a degree a minute, a quarter minute late
  CHECK(lead(of_15_s_dps) < 3.0);
  CHECK(lead(-4.0 * of_15_s_dps) > 10.0);
  CHECK(lead(100.0 * of_15_s_dps) > 10.0);  // half an hour late would no longer follow the rate
}

TEST_CASE("going up and down tells aging from self-heating where going up alone does not") {
  const double up = lead_of_aging_over_self_heating("up");
  const double up_down = lead_of_aging_over_self_heating("up_down");
  INFO("up " << up << ", up and down " << up_down);
  CHECK(up_down > 3.0 * up);
}

TEST_CASE("the smallest aging seen is what the effects sheet measured, within a factor of two") {
  // 3 mdps/h on a single sweep, 1 mdps/h up and down, at 0.1 deg/s per 50 Hz sample.
  for (const auto& [plan, sheet] : {std::pair{"up", 3.0}, std::pair{"up_down", 1.0}}) {
    const auto setting = quiet(plan, false);
    const auto over = setting.trajectory(setting.chain);
    const Sight sight(over, setting.baseline, aging(over), "aging_drift",
                      setting.white_per_root_hz(), {});
    INFO(plan << " " << sight.smallest_amplitude());
    CHECK(std::abs(std::log2(sight.smallest_amplitude() / sheet)) < 1.0);
  }
}

TEST_CASE("what is no effect gains nothing, and a larger one gains more") {
  const auto setting = quiet("up_down", false);
  const auto over = setting.trajectory(setting.chain);
  const Sight sight(over, setting.baseline, aging(over), "aging_drift", setting.white_per_root_hz(),
                    {});
  CHECK(sight.at(0.0).gain_nats == Approx(0.0).margin(1e-6));
  CHECK(sight.at(sight.smallest_amplitude()).gain_nats == Approx(16.5).margin(0.1));
  CHECK(sight.at(2.0 * sight.smallest_amplitude()).gain_nats > 17.0);
}

TEST_CASE("the flicker put into nulls is below what anyone may be asked to see") {
  // 0.12 of the white of a bin makes each half-decade 0.183 x 0.12^2 = 0.0026 of its variance.
  CHECK(hidden::flicker_gain_nats(0.0026) < 1.0);
  CHECK(hidden::flicker_gain_nats(0.5) > 50.0);
}
