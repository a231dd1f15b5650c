#include "daemon/runner/begin.h"

#include <fmt/core.h>

#include <algorithm>

namespace gyrocal::runner {
namespace {

CampaignRow row_of(const CampaignConfig& config, const std::string& version, std::int64_t utc_ns) {
  CampaignRow row;
  row.name = config.name;
  row.config_toml = config.text;
  row.software_version = version;
  row.utc_start_ns = utc_ns;
  row.simulated = config.simulated;
  row.time_scale = config.time_scale;
  row.samples_per_setpoint = config.plan.samples_per_setpoint;
  row.sample_rate_hz = config.plan.sample_rate_hz;
  row.monitor_interval_s = campaign::monitor_interval_s;
  row.state = campaign::name(campaign::Preflight{});
  return row;
}

BoardRow row_of(const BoardConfig& config, const BoardIdentity& identity) {
  BoardRow row;
  row.name = config.name;
  row.device = config.device;
  row.mcu_id = identity.mcu_id;
  row.firmware_version = identity.firmware_version;
  row.hardware_version = identity.hardware_version;
  row.lsb_per_dps = config.lsb_per_dps;
  row.lsb_per_dps_per_k = config.lsb_per_dps_per_k;
  return row;
}

/// The board's row; one that a crash kept from being written is written now.
Result<BoardId> same_board(Store& store, const OpenCampaign& open, const BoardConfig& config,
                           const BoardIdentity& identity) {
  for (const auto& [id, row] : open.boards) {
    if (row.name != config.name) continue;
    if (row.mcu_id == identity.mcu_id) return id;
    return fail(Errc::mismatch,
                fmt::format("board '{}' is MCU id {}; the campaign was begun with {}", config.name,
                            identity.mcu_id, row.mcu_id),
                "plug in the board the campaign was begun with");
  }
  return store.add_board(open.id, row_of(config, identity));
}

std::vector<std::vector<bool>> accepted_so_far(const OpenCampaign& open,
                                               const std::vector<BoardId>& boards,
                                               std::size_t setpoints) {
  std::vector<std::vector<bool>> accepted(setpoints, std::vector<bool>(boards.size(), false));
  for (const DwellRow& dwell : open.dwells) {
    const auto board = std::find(boards.begin(), boards.end(), dwell.board);
    if (dwell.reject_reason || board == boards.end()) continue;
    accepted[static_cast<std::size_t>(dwell.ordinal)]
            [static_cast<std::size_t>(board - boards.begin())] = true;
  }
  return accepted;
}

/// The last setpoint a dwell was tried at, if a board still lacks its dwell there and nobody has
/// skipped it; else the one after it. Earlier gaps were given up or skipped. Who spoilt former
/// tries is not told apart here, so one more is always left.
campaign::Event first_unfinished(const CampaignConfig& config, const OpenCampaign& open,
                                 const std::vector<std::vector<bool>>& accepted) {
  campaign::Visit visit;
  if (!open.dwells.empty()) {
    int last = 0;
    for (const DwellRow& dwell : open.dwells) last = std::max(last, dwell.ordinal);
    visit.point = static_cast<std::size_t>(last);
    int tried = 0;
    bool skipped = false;
    for (const DwellRow& dwell : open.dwells) {
      if (dwell.ordinal != last) continue;
      tried = std::max(tried, dwell.attempt);
      skipped = skipped || dwell.reject_reason == campaign::skipped;
    }
    const auto& have = accepted[visit.point];
    const bool all = std::all_of(have.begin(), have.end(), [](bool has) { return has; });
    if (all || skipped) {
      ++visit.point;
    } else {
      visit.attempt = tried + 1;
      visit.disturbed = std::min(tried, config.limits.dwell_attempts_max - 1);
    }
  }
  if (visit.point >= config.plan.setpoints.size()) return campaign::NothingLeft{};
  return campaign::Ready{visit};
}

}  // namespace

Result<CampaignLoop::Begin> begin_new(const CampaignConfig& config, const Found& found,
                                      const Clock& clock, Store& store,
                                      const std::string& software_version) {
  std::vector<SetpointRow> setpoints;
  for (const Celsius setpoint : config.plan.setpoints) {
    setpoints.push_back({static_cast<int>(setpoints.size()), setpoint});
  }
  CampaignLoop::Begin begin;
  begin.origin = clock.now();
  auto campaign = store.begin_campaign(row_of(config, software_version, clock.utc_ns()), setpoints);
  if (!campaign) return tl::unexpected(campaign.error());
  begin.campaign = *campaign;
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    auto board = store.add_board(*campaign, row_of(config.boards[i], found.boards[i]));
    if (!board) return tl::unexpected(board.error());
    begin.boards.push_back(*board);
  }
  begin.accepted.assign(setpoints.size(), std::vector<bool>(config.boards.size(), false));
  return begin;
}

Result<CampaignLoop::Begin> begin_again(const CampaignConfig& config, const Found& found,
                                        const Clock& clock, Store& store,
                                        const OpenCampaign& open) {
  if (config.text != open.campaign.config_toml) {
    return fail(Errc::mismatch,
                fmt::format("the campaign file differs from the one campaign '{}' was begun with",
                            open.campaign.name),
                "restore it (the database keeps it in campaign.config_toml), or begin anew with "
                "another --db");
  }
  CampaignLoop::Begin begin;
  begin.campaign = open.id;
  for (std::size_t i = 0; i < config.boards.size(); ++i) {
    auto board = same_board(store, open, config.boards[i], found.boards[i]);
    if (!board) return tl::unexpected(board.error());
    begin.boards.push_back(*board);
  }
  const auto elapsed_utc = static_cast<double>(clock.utc_ns() - open.campaign.utc_start_ns);
  const auto elapsed = Duration{static_cast<std::int64_t>(elapsed_utc * config.time_scale)};
  begin.t = std::max(elapsed, Duration{open.t_last_ns} + apart_from_before);
  begin.origin = clock.now() - begin.t;
  begin.accepted = accepted_so_far(open, begin.boards, config.plan.setpoints.size());
  begin.first = first_unfinished(config, open, begin.accepted);
  begin.resumed = fmt::format("{:.0f} s after it was last seen {}",
                              to_seconds(begin.t - Duration{open.t_last_ns}), open.campaign.state);
  return begin;
}

}  // namespace gyrocal::runner
