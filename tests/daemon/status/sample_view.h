#pragma once

#include "daemon/status/view.h"

namespace gyrocal::status {

/// Two boards, three setpoints, ten times as fast as the machine's time.
inline Facts sample_facts() {
  Facts facts;
  facts.campaign = "weekend";
  facts.campaign_path = "weekend.toml";
  facts.database = "weekend.db";
  facts.software_version = "1.2.3";
  facts.simulated = true;
  facts.time_scale = 10;
  facts.setpoints_c = {10, 20, 30};
  facts.slope_limit_k_per_h = 2;
  facts.frames_lost_share_max = 0.01;
  facts.chamber_stale_s = 30;
  facts.soak_s_max = 7200;
  const ScaleFactor scale{4, 0};
  facts.boards = {{"left", {scale, scale, scale}}, {"right", {scale, scale, scale}}};
  return facts;
}

/// Soaking at the second setpoint after 1000 s, both boards well.
inline runner::Snapshot sample_snapshot() {
  runner::Snapshot now;
  now.t = seconds(1000);
  now.since = seconds(900);
  now.state = "soaking";
  now.text = "soaking at 20.0 degC (point 2 of 3)";
  now.setpoints = 3;
  now.setpoints_done = 1;
  now.air = Celsius{20.5};
  now.setpoint = Celsius{20};
  now.left = seconds(3600);
  now.left_max = seconds(4800);
  now.chamber_age = seconds(3);
  now.boards = 2;
  now.boards_present = 2;
  for (const char* name : {"left", "right"}) {
    runner::BoardSnapshot board;
    board.name = name;
    board.present = true;
    board.frames = 9990;
    board.frames_missing = 10;
    runner::SlowInterval interval;
    interval.frames = 250;
    interval.gyro_sum_lsb = {250 * 4, 250 * 8, 250 * -4};
    board.latest = interval;
    board.slope_k_per_h = -1.5;
    now.each_board.push_back(board);
  }
  return now;
}

inline constexpr std::int64_t sample_utc_ns = 1'763'000'000'000'000'000;  // 2025-11-13 02:13:20

inline View sample_view(const runner::Snapshot& now = sample_snapshot(),
                        const std::vector<EventInsert>& events = {}) {
  LiveStatus live(sample_facts());
  for (const EventInsert& event : events) live.report(event);
  live.report(now, 100);
  return live.at(sample_utc_ns, 100);
}

}  // namespace gyrocal::status
