#include "tests/bench/sample_campaign.h"

#include <fmt/format.h>

#include <cmath>

namespace gyrocal::bench {
namespace {

constexpr double sample_rate_hz = 50;
constexpr double setpoint_spacing_s = 2160;  // 25 of them in 15 h

Celsius setpoint_of(int ordinal) { return Celsius{-10 + 2.5 * (ordinal % 25)}; }

Result<void> write_group(Store& store, CampaignId campaign, const CampaignShape& shape, int ordinal,
                         const std::vector<BoardId>& boards, std::mt19937& random) {
  const double board_c = setpoint_of(ordinal).value + 1;
  std::vector<std::vector<BoardSample>> samples;
  for (int i = 0; i < shape.boards; ++i) {
    samples.push_back(dwell_at(board_c, shape.dwell_samples, random));
  }
  std::vector<DwellWithSamples> group;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    group.push_back({dwell_row(boards[i], ordinal, samples[i]), samples[i]});
  }
  const auto stored = store.add_group(campaign, group);
  return stored ? Result<void>{} : tl::unexpected(stored.error());
}

Result<void> write_monitor(Store& store, CampaignId campaign, const CampaignShape& shape,
                           BoardId board) {
  std::vector<MonitorInsert> rows;
  for (int i = 0; i < shape.monitor_rows; ++i) {
    const double t_s = 5 * i + 2.5;
    MonitorInsert& row = rows.emplace_back();
    row.board = board;
    row.t_ns = static_cast<std::int64_t>(1e9 * t_s);
    row.setpoint_c = setpoint_of(static_cast<int>(t_s / setpoint_spacing_s)).value;
    row.chamber_c = row.setpoint_c + 0.1 * std::sin(t_s / 60);
    row.board_c = row.chamber_c + 1;
    row.gyro_mean_lsb = {17.3, 17.9, 18.1};
    row.frames = static_cast<std::int64_t>(5 * sample_rate_hz);
  }
  return store.add_monitor(campaign, rows);
}

}  // namespace

std::vector<BoardSample> dwell_at(double board_c, int samples, std::mt19937& random) {
  constexpr double lsb_per_dps = 4.13;
  std::normal_distribution<double> noise_dps(0, 1.31);
  std::vector<BoardSample> dwell(static_cast<std::size_t>(samples));
  for (std::size_t i = 0; i < dwell.size(); ++i) {
    BoardSample& sample = dwell[i];
    sample.t_ns = static_cast<std::int64_t>(1e9 / sample_rate_hz) * static_cast<std::int64_t>(i) +
                  3'600'000'000'000;  // an hour into the campaign
    sample.counter = static_cast<std::uint32_t>(i + 1);
    sample.temperature_raw = static_cast<std::int16_t>(board_c * 256);
    for (std::int16_t& lsb : sample.gyro_lsb) {
      const double rate_dps = 4.3 - 0.01 * board_c + 1e-4 * board_c * board_c + noise_dps(random);
      lsb = static_cast<std::int16_t>(std::lround(lsb_per_dps * rate_dps));
    }
  }
  return dwell;
}

DwellRow dwell_row(BoardId board, int ordinal, std::span<const BoardSample> samples) {
  DwellRow row;
  row.board = board;
  row.ordinal = ordinal;
  row.t_start_ns = samples.front().t_ns;
  row.t_end_ns = samples.back().t_ns;
  row.soak_s = 1800;
  row.board_mean_c = *samples.front().temperature_raw / 256.0;
  return row;
}

Result<CampaignId> begin_campaign(Store& store, const CampaignShape& shape,
                                  std::vector<BoardId>& boards) {
  std::vector<SetpointRow> plan;
  for (int i = 0; i < shape.setpoints; ++i) plan.push_back({i, setpoint_of(i)});
  CampaignRow row;
  row.name = shape.name;
  row.samples_per_setpoint = shape.dwell_samples;
  row.sample_rate_hz = sample_rate_hz;
  row.state = "analysing";
  auto campaign = store.begin_campaign(row, plan);
  if (!campaign) return campaign;
  for (int i = 0; i < shape.boards; ++i) {
    const auto board = store.add_board(*campaign, {.name = fmt::format("board{}", i),
                                                   .device = "bench",
                                                   .mcu_id = "",
                                                   .firmware_version = "",
                                                   .hardware_version = "",
                                                   .lsb_per_dps = {4.13, 4.13, 4.13},
                                                   .lsb_per_dps_per_k = {0.002, 0.002, 0.002}});
    if (!board) return tl::unexpected(board.error());
    boards.push_back(*board);
  }
  return campaign;
}

Result<CampaignId> write_campaign(Store& store, const CampaignShape& shape) {
  std::vector<BoardId> boards;
  auto campaign = begin_campaign(store, shape, boards);
  if (!campaign) return campaign;
  std::mt19937 random(11);
  for (int i = 0; i < shape.setpoints; ++i) {
    auto done = write_group(store, *campaign, shape, i, boards, random);
    if (!done) return tl::unexpected(done.error());
  }
  for (const BoardId board : boards) {
    if (shape.monitor_rows == 0) break;
    auto done = write_monitor(store, *campaign, shape, board);
    if (!done) return tl::unexpected(done.error());
  }
  return campaign;
}

Result<CampaignConfig> demo_campaign() {
  return read_campaign(GYROCAL_SOURCE_DIR "/config/campaigns/demo.toml");
}

}  // namespace gyrocal::bench
