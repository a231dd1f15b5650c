#pragma once

#include <vector>

#include "schema/store.h"

/// A campaign of three setpoints and two boards, a few samples each: enough for every table.
namespace small_campaign {

inline gyrocal::CampaignRow campaign() {
  gyrocal::CampaignRow row;
  row.name = "small";
  row.config_toml = "[campaign]\nname = \"small\"\n";
  row.software_version = "0.1.0";
  row.utc_start_ns = 1'700'000'000'000'000'000;
  row.simulated = true;
  row.time_scale = 400;
  row.samples_per_setpoint = 5;
  row.sample_rate_hz = 50;
  row.state = "preflight";
  return row;
}

inline std::vector<gyrocal::SetpointRow> setpoints() { return {{0, {-10}}, {1, {20}}, {2, {50}}}; }

inline gyrocal::BoardRow board(const std::string& name) {
  gyrocal::BoardRow row;
  row.name = name;
  row.device = "/dev/" + name;
  row.mcu_id = "00112233445566778899AABB";
  row.firmware_version = "iNEMO Firmware_Version_2.2";
  row.hardware_version = "iNEMO V2 Hardware_Version_1";
  row.lsb_per_dps = {4.0, 4.13, 5.0};
  row.lsb_per_dps_per_k = {0.0, 0.0, 0.1};
  return row;
}

/// `count` samples at 50 Hz; gyro_z is 10, 11, 12 ...
inline std::vector<gyrocal::BoardSample> samples(int ordinal, int count) {
  std::vector<gyrocal::BoardSample> rows;
  for (int i = 0; i < count; ++i) {
    gyrocal::BoardSample sample;
    sample.t_ns = ordinal * 1'000'000'000'000 + i * 20'000'000LL;
    sample.counter = static_cast<std::uint32_t>(100 + i);
    sample.gyro_lsb = {static_cast<std::int16_t>(-i), 0, static_cast<std::int16_t>(10 + i)};
    sample.temperature_raw = static_cast<std::int16_t>(30 * 256);
    rows.push_back(sample);
  }
  return rows;
}

inline gyrocal::DwellRow dwell(gyrocal::BoardId board, int ordinal, int attempt = 1) {
  gyrocal::DwellRow row;
  row.board = board;
  row.ordinal = ordinal;
  row.attempt = attempt;
  row.t_start_ns = ordinal * 1'000'000'000'000;
  row.t_end_ns = row.t_start_ns + 100'000'000;
  row.soak_s = 420;
  row.timed_soak = true;
  row.chamber_mean_c = 30.1;
  row.chamber_peak_to_peak_k = 0.2;
  row.board_mean_c = 30;
  return row;
}

struct Ids {
  gyrocal::CampaignId campaign;
  gyrocal::BoardId first;
  gyrocal::BoardId second;
};

/// The campaign with its two boards, nothing logged yet.
inline Ids begin(gyrocal::Store& store) {
  const auto points = setpoints();
  Ids ids{};
  ids.campaign = store.begin_campaign(campaign(), points).value();
  ids.first = store.add_board(ids.campaign, board("first")).value();
  ids.second = store.add_board(ids.campaign, board("second")).value();
  return ids;
}

/// Both boards' accepted dwells of `count` samples at one setpoint.
inline gyrocal::Result<std::vector<gyrocal::DwellId>> log_group(gyrocal::Store& store,
                                                                const Ids& ids, int ordinal,
                                                                int count = 5) {
  const auto rows = samples(ordinal, count);
  const std::vector<gyrocal::DwellWithSamples> group{{dwell(ids.first, ordinal), rows},
                                                     {dwell(ids.second, ordinal), rows}};
  return store.add_group(ids.campaign, group);
}

}  // namespace small_campaign
