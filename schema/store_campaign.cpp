// What a campaign writes as it goes, but for the dwells: see store_group.cpp.
#include <fmt/core.h>

#include <algorithm>

#include "schema/store_impl.h"

namespace gyrocal {
namespace {

std::string axes_of(const BoardRow& board) {
  std::string axes;
  for (const Axis axis : all_axes) {
    if (board.measured.at(static_cast<std::size_t>(axis))) axes += letter(axis);
  }
  return axes;
}

}  // namespace

Result<CampaignId> Store::begin_campaign(const CampaignRow& campaign,
                                         std::span<const SetpointRow> setpoints) {
  CampaignId id{};
  const auto stored =
      impl_->write(fmt::format("campaign \"{}\"", campaign.name), [&]() -> Result<void> {
        auto done = run(impl_->database,
                        "INSERT INTO campaign (name, config_toml, software_version, utc_start_ns, "
                        "simulated, time_scale, samples_per_setpoint, sample_rate_hz, "
                        "monitor_interval_s, state) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                        campaign.name, campaign.config_toml, campaign.software_version,
                        campaign.utc_start_ns, campaign.simulated, campaign.time_scale,
                        campaign.samples_per_setpoint, campaign.sample_rate_hz,
                        campaign.monitor_interval_s, campaign.state);
        if (!done) return done;
        id = CampaignId{impl_->database.last_insert_id()};
        auto insert = impl_->database.prepare(
            "INSERT INTO setpoint (campaign_id, ordinal, setpoint_c) VALUES (?, ?, ?)");
        if (!insert) return tl::unexpected(insert.error());
        for (const SetpointRow& point : setpoints) {
          done = insert->run(key(id), point.ordinal, point.setpoint.value);
          if (!done) return done;
        }
        return done;
      });
  if (!stored) return tl::unexpected(stored.error());
  return id;
}

Result<BoardId> Store::add_board(CampaignId campaign, const BoardRow& board) {
  BoardId id{};
  const auto stored = impl_->write(fmt::format("board \"{}\"", board.name), [&]() -> Result<void> {
    auto done = run(impl_->database,
                    "INSERT INTO board (campaign_id, name, device, mcu_id, firmware_version, "
                    "hardware_version, axes, lsb_per_dps_x, lsb_per_dps_y, lsb_per_dps_z, "
                    "lsb_per_dps_per_k_x, lsb_per_dps_per_k_y, lsb_per_dps_per_k_z) "
                    "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                    key(campaign), board.name, board.device, board.mcu_id, board.firmware_version,
                    board.hardware_version, axes_of(board), board.lsb_per_dps[0],
                    board.lsb_per_dps[1], board.lsb_per_dps[2], board.lsb_per_dps_per_k[0],
                    board.lsb_per_dps_per_k[1], board.lsb_per_dps_per_k[2]);
    id = BoardId{impl_->database.last_insert_id()};
    return done;
  });
  if (!stored) return tl::unexpected(stored.error());
  return id;
}

Result<void> Store::set_campaign_state(CampaignId campaign, const std::string& state) {
  return impl_->write("state " + state, [&] {
    return run(impl_->database, "UPDATE campaign SET state = ? WHERE id = ?", state, key(campaign));
  });
}

Result<void> Store::add_monitor(CampaignId campaign, std::span<const MonitorInsert> rows) {
  return impl_->write("monitor rows", [&]() -> Result<void> {
    const auto known = boards_of(impl_->database, campaign);
    if (!known) return tl::unexpected(known.error());
    // VALUES, not SELECT from board: SQLite would journal a page for each row.
    auto insert =
        impl_->database.prepare("INSERT INTO monitor VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    if (!insert) return tl::unexpected(insert.error());
    for (const MonitorInsert& row : rows) {
      if (!std::binary_search(known->begin(), known->end(), key(row.board))) {
        return fail(Errc::bad_input,
                    fmt::format("board {} is not in campaign {}", key(row.board), key(campaign)));
      }
      auto done = insert->run(key(row.board), row.t_ns, row.setpoint_c, row.chamber_c, row.board_c,
                              row.gyro_mean_lsb[0], row.gyro_mean_lsb[1], row.gyro_mean_lsb[2],
                              row.frames, row.frames_missing);
      if (!done) return done;
    }
    return {};
  });
}

Result<void> Store::add_event(CampaignId campaign, const EventInsert& event) {
  return impl_->write("event " + event.kind, [&] {
    return run(impl_->database,
               "INSERT INTO event (campaign_id, t_ns, utc_ns, severity, kind, text) "
               "VALUES (?, ?, ?, ?, ?, ?)",
               key(campaign), event.t_ns, event.utc_ns, event.severity, event.kind, event.text);
  });
}

}  // namespace gyrocal
