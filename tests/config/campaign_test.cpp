#include "config/campaign.h"

#include <catch2/catch.hpp>
#include <string>

using namespace gyrocal;

namespace {

const std::string shipped = GYROCAL_SOURCE_DIR "/config/campaigns/";

const std::string smallest = R"(
[campaign]
name = "small"
[chamber]
profile = "yinhe"
host = "192.0.2.5"
[[board]]
name = "a"
device = "/dev/serial/by-id/a"
)";

}  // namespace

TEST_CASE("the smallest campaign takes the paper's plan and every default", "[config]") {
  const auto campaign = parse_campaign(smallest, "folder/small.toml");
  REQUIRE(campaign.has_value());
  CHECK(campaign->name == "small");
  CHECK(campaign->database == "folder/small.db");
  CHECK(campaign->text == smallest);
  CHECK_FALSE(campaign->simulated);
  CHECK(campaign->time_scale == 1.0);
  CHECK(campaign->plan.setpoints.size() == 25);
  CHECK(campaign->plan.setpoints.front() == Celsius{-10});
  CHECK(campaign->plan.setpoints.back() == Celsius{50});
  CHECK(campaign->plan.samples_per_setpoint == 3000);
  CHECK(campaign->chamber.profile.temperature_setpoint.address == 1742);
  CHECK(campaign->chamber.unit == 1);
  CHECK(std::get<TcpAddress>(campaign->chamber.address).port == 502);
  CHECK(campaign->boards.at(0).lsb_per_dps == std::array<double, 3>{4.13, 4.13, 4.13});
  CHECK_FALSE(campaign->boards.at(0).mcu_id.has_value());
  CHECK(campaign->analysis.wavelet == "db4");
}

TEST_CASE("what a campaign file says is what is read", "[config]") {
  const auto campaign = parse_campaign(R"(
    [campaign]
    name = "full"
    simulated = true
    time_scale = 250
    database = "/data/full.db"
    [plan]
    setpoints_c = [20, -5, 20.5]
    sweep = "as_listed"
    shuffle_seed = 9
    samples_per_setpoint = 200
    sample_rate_hz = 400
    ramp_k_per_min = 3
    safe_setpoint_c = 22
    [chamber]
    profile = "yinhe"
    device = "/dev/ttyUSB0"
    baud = 19200
    parity = "even"
    stop_bits = 2
    unit = 7
    reply_timeout_s = 2
    poll_interval_s = 1
    [[board]]
    name = "a"
    device = "/dev/ttyACM0"
    mcu_id = "0123456789abcdefABCDEF00"
    lsb_per_dps = [4.13, 4.13, 4.657]
    lsb_per_dps_per_k = [0, 0, -0.001]
    limit_min_c = -10
    limit_max_c = 60
    [stability]
    air_band_k = 0.4
    [limits]
    dwell_band_k = 0.9
    chamber_stale_s = 12
    [analysis]
    level = 4)",
                                       "full.toml");
  if (!campaign) FAIL(campaign.error().what);
  CHECK(campaign->time_scale == 250);
  CHECK(campaign->database == "/data/full.db");
  CHECK(campaign->plan.setpoints == std::vector<Celsius>{{20}, {-5}, {20.5}});
  CHECK(campaign->plan.sample_rate_hz == 400);
  CHECK(campaign->plan.ramp_per_minute == Kelvin{3});
  const auto& rtu = std::get<RtuAddress>(campaign->chamber.address);
  CHECK(rtu.device == "/dev/ttyUSB0");
  CHECK(rtu.baud == 19200);
  CHECK(rtu.parity == 'E');
  CHECK(rtu.stop_bits == 2);
  CHECK(campaign->chamber.unit == 7);
  CHECK(campaign->boards.at(0).mcu_id == "0123456789abcdefABCDEF00");
  CHECK(campaign->boards.at(0).lsb_per_dps.at(2) == 4.657);
  CHECK(campaign->boards.at(0).lsb_per_dps_per_k.at(2) == -0.001);
  CHECK(campaign->stability.air_band == Kelvin{0.4});
  CHECK(campaign->limits.dwell_band == Kelvin{0.9});
  CHECK(campaign->limits.chamber_stale_s == 12);
  CHECK(campaign->analysis.level == 4);
  CHECK(allowed_setpoints(*campaign).min == Celsius{-10});
  CHECK(allowed_setpoints(*campaign).max == Celsius{60});
}

TEST_CASE("the shipped campaigns are sound", "[config]") {
  for (const char* name : {"demo", "weekend"}) {
    const auto campaign = read_campaign(shipped + name + ".toml");
    if (!campaign) FAIL(campaign.error().what);
    CHECK(campaign->name == name);
    CHECK(campaign->database == shipped + name + ".db");
  }
  const auto demo = read_campaign(shipped + "demo.toml");
  CHECK(demo->simulated);
  CHECK(demo->plan.setpoints.size() == 25);
  CHECK(demo->boards.size() == 2);
}

TEST_CASE("the commented example names every default as it is", "[config]") {
  const auto weekend = read_campaign(shipped + "weekend.toml");
  REQUIRE(weekend.has_value());
  const StabilityConfig stability;
  CHECK(weekend->stability.air_band == stability.air_band);
  CHECK(weekend->stability.air_peak_to_peak == stability.air_peak_to_peak);
  CHECK(weekend->stability.air_window_s == stability.air_window_s);
  CHECK(weekend->stability.board_slope_k_per_h == stability.board_slope_k_per_h);
  CHECK(weekend->stability.board_window_s == stability.board_window_s);
  CHECK(weekend->stability.soak_s_min == stability.soak_s_min);
  CHECK(weekend->stability.soak_s_max == stability.soak_s_max);
  const LimitConfig limits;
  CHECK(weekend->limits.chamber_stale_s == limits.chamber_stale_s);
  CHECK(weekend->limits.board_stale_s == limits.board_stale_s);
  CHECK(weekend->limits.ramp_timeout_factor == limits.ramp_timeout_factor);
  CHECK(weekend->limits.ramp_timeout_extra_s == limits.ramp_timeout_extra_s);
  CHECK(weekend->limits.frames_lost_share_max == limits.frames_lost_share_max);
  CHECK(weekend->limits.dwell_attempts_max == limits.dwell_attempts_max);
  CHECK(weekend->limits.board_away_s_max == limits.board_away_s_max);
  CHECK(weekend->limits.dwell_band == limits.dwell_band);
}
