// A slice of the database as the diagnosis reads it: one axis of one board over its campaign.
#include <fmt/core.h>

#include <map>

#include "compensation/values/scale_factor.h"
#include "schema/store_impl.h"

namespace gyrocal {
namespace {

const std::string gyro_columns[] = {"gyro_x", "gyro_y", "gyro_z"};

/// Divided, not multiplied by 1e-9: whole milliseconds stay the nearest double.
double seconds(std::int64_t t_ns) { return static_cast<double>(t_ns) / 1e9; }

Result<void> read_monitor(const Database& database, BoardId board, Axis axis,
                          const ScaleFactor& scale, Session& into) {
  return for_each_row(
      database,
      fmt::format("SELECT t_ns, setpoint_c, chamber_c, board_c, {}_mean_lsb FROM monitor "
                  "WHERE board_id = ? ORDER BY t_ns",
                  gyro_columns[static_cast<std::size_t>(axis)]),
      [&](const Statement& row) {
        const double board_c = row.real(3);
        into.monitor.push_back({seconds(row.integer(0)), row.real(1), row.real(2), board_c,
                                scale.to_dps(row.real(4), board_c)});
      },
      key(board));
}

struct StoredDwell {
  std::int64_t id;
  int ordinal;
  double board_mean_c;
};

Result<std::vector<StoredDwell>> read_dwells(const Database& database, CampaignId campaign,
                                             BoardId board, Session& into) {
  std::vector<StoredDwell> dwells;
  const auto read = for_each_row(
      database,
      "SELECT dwell.id, ordinal, setpoint_c, t_start_ns, board_mean_c FROM dwell "
      "JOIN setpoint USING (campaign_id, ordinal) WHERE campaign_id = ? AND board_id = ? AND "
      "reject_reason IS NULL ORDER BY t_start_ns",
      [&](const Statement& row) {
        const auto ordinal = static_cast<int>(row.integer(1));
        dwells.push_back({row.integer(0), ordinal, row.real(4)});
        into.dwells.push_back({ordinal, row.real(2), seconds(row.integer(3))});
      },
      key(campaign), key(board));
  if (!read) return tl::unexpected(read.error());
  return dwells;
}

Result<void> read_samples(const Database& database, const StoredDwell& dwell, Axis axis,
                          const ScaleFactor& scale, Session& into) {
  return for_each_row(
      database,
      fmt::format("SELECT seq, t_ns, {}_lsb, temperature_raw FROM sample WHERE dwell_id = ? "
                  "ORDER BY seq",
                  gyro_columns[static_cast<std::size_t>(axis)]),
      [&](const Statement& row) {
        SessionSample sample;
        sample.dwell = dwell.ordinal;
        sample.seq = row.integer(0);
        sample.t_s = seconds(row.integer(1));
        sample.board_c = row.real(3) / 256.0;
        const bool known = !row.is_null(3);
        sample.gyro_dps = scale.to_dps(row.real(2), known ? sample.board_c : dwell.board_mean_c);
        into.samples.push_back(sample);
      },
      dwell.id);
}

}  // namespace

Result<Session> Store::session(CampaignId campaign_id, BoardId board_id, Axis axis) const {
  const auto campaign = this->campaign(campaign_id);
  if (!campaign) return tl::unexpected(campaign.error());
  const auto boards = this->boards(campaign_id);
  if (!boards) return tl::unexpected(boards.error());
  const BoardRow* board = nullptr;
  for (const auto& [id, row] : *boards) {
    if (id == board_id) board = &row;
  }
  const auto i = static_cast<std::size_t>(axis);
  if (board == nullptr || !board->measured.at(i)) {
    return fail(Errc::unknown_name,
                fmt::format("{}: campaign {} has no board {} with axis {}", impl_->database.path(),
                            key(campaign_id), key(board_id), letter(axis)),
                "`gyrocal db` lists boards and axes");
  }
  const ScaleFactor scale{board->lsb_per_dps.at(i), board->lsb_per_dps_per_k.at(i)};
  Session session;
  session.device = board->name;
  session.axis = letter(axis);
  session.sample_rate_hz = campaign->sample_rate_hz;
  session.monitor_interval_s = campaign->monitor_interval_s;
  session.lsb_dps = 1.0 / scale.lsb_per_dps;
  session.samples_per_dwell = campaign->samples_per_setpoint;
  auto read = read_monitor(impl_->database, board_id, axis, scale, session);
  if (!read) return tl::unexpected(read.error());
  const auto dwells = read_dwells(impl_->database, campaign_id, board_id, session);
  if (!dwells) return tl::unexpected(dwells.error());
  for (const StoredDwell& dwell : *dwells) {
    read = read_samples(impl_->database, dwell, axis, scale, session);
    if (!read) return tl::unexpected(read.error());
  }
  return session;
}

}  // namespace gyrocal
