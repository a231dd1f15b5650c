#include <fmt/core.h>

#include "schema/store_impl.h"

namespace gyrocal {
namespace {

constexpr char latest_analysis[] = "(SELECT max(id) FROM analysis WHERE campaign_id = ?)";

CampaignRow campaign_from(const Statement& row) {
  CampaignRow campaign;
  campaign.name = row.text(1);
  campaign.config_toml = row.text(2);
  campaign.software_version = row.text(3);
  campaign.utc_start_ns = row.integer(4);
  campaign.simulated = row.integer(5) != 0;
  campaign.time_scale = row.real(6);
  campaign.samples_per_setpoint = static_cast<int>(row.integer(7));
  campaign.sample_rate_hz = row.real(8);
  campaign.monitor_interval_s = row.real(9);
  campaign.state = row.text(10);
  return campaign;
}

BoardRow board_from(const Statement& row) {
  BoardRow board;
  board.name = row.text(1);
  board.device = row.text(2);
  board.mcu_id = row.text(3);
  board.firmware_version = row.text(4);
  board.hardware_version = row.text(5);
  for (const Axis axis : all_axes) {
    const auto i = static_cast<std::size_t>(axis);
    board.measured.at(i) = row.text(6).find(letter(axis)) != std::string::npos;
    board.lsb_per_dps.at(i) = row.real(7 + static_cast<int>(i));
    board.lsb_per_dps_per_k.at(i) = row.real(10 + static_cast<int>(i));
  }
  return board;
}

DwellRow dwell_from(const Statement& row) {
  DwellRow dwell;
  dwell.board = BoardId{row.integer(0)};
  dwell.ordinal = static_cast<int>(row.integer(1));
  dwell.attempt = static_cast<int>(row.integer(2));
  dwell.t_start_ns = row.integer(3);
  dwell.t_end_ns = row.integer(4);
  dwell.soak_s = row.real(5);
  dwell.timed_soak = row.integer(6) != 0;
  dwell.chamber_mean_c = row.real(7);
  dwell.chamber_peak_to_peak_k = row.real(8);
  dwell.board_mean_c = row.real(9);
  dwell.frames_missing = row.integer(10);
  if (!row.is_null(11)) dwell.reject_reason = row.text(11);
  return dwell;
}

/// Columns of select_samples. A counter that stands in the row itself follows a restart.
BoardSample sample_from(const Statement& row, std::int64_t counter_first) {
  BoardSample sample;
  sample.t_ns = row.integer(0);
  sample.counter =
      static_cast<std::uint32_t>(row.is_null(2) ? counter_first + row.integer(1) : row.integer(2));
  for (int axis = 0; axis < 3; ++axis) {
    sample.gyro_lsb[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(row.integer(3 + axis));
  }
  if (!row.is_null(6)) sample.temperature_raw = static_cast<std::int16_t>(row.integer(6));
  return sample;
}

/// Columns as Store::models() selects them.
ModelInsert model_from(const Statement& row, BoardId board, Axis axis) {
  ModelInsert model;
  model.board = board;
  model.axis = axis;
  model.method = row.text(1);
  model.parameters_json = row.text(2);
  model.rmse_dps = row.real(3);
  model.rmse_n_minus_1_dps = row.real(4);
  model.mae_dps = row.real(5);
  model.max_dps = row.real(6);
  model.loocv_rmse_dps = row.real(7);
  model.block_rmse_dps = row.real(8);
  model.effective_parameters = row.real(9);
  model.recommended = row.integer(10) != 0;
  model.reason = row.text(11);
  model.warnings = row.text(12);
  model.dwells_sha256 = row.text(13);
  return model;
}

constexpr char select_samples[] =
    "SELECT t_ns, seq, counter, gyro_x_lsb, gyro_y_lsb, gyro_z_lsb, temperature_raw FROM sample "
    "WHERE dwell_id = ? ORDER BY seq";

constexpr char select_dwells[] =
    "SELECT board_id, ordinal, attempt, t_start_ns, t_end_ns, soak_s, timed_soak, "
    "chamber_mean_c, chamber_peak_to_peak_k, board_mean_c, frames_missing, reject_reason "
    "FROM dwell WHERE campaign_id = ? ORDER BY id";

constexpr char select_campaign[] =
    "SELECT id, name, config_toml, software_version, utc_start_ns, simulated, time_scale, "
    "samples_per_setpoint, sample_rate_hz, monitor_interval_s, state FROM campaign ";

constexpr char t_last[] =
    "SELECT max(coalesce((SELECT max(t_ns) FROM event WHERE campaign_id = ?1), 0), "
    "coalesce((SELECT max(t_end_ns) FROM dwell WHERE campaign_id = ?1), 0), "
    "coalesce((SELECT max((SELECT max(t_ns) FROM monitor WHERE board_id = board.id)) "
    "FROM board WHERE campaign_id = ?1), 0))";

}  // namespace

Result<void> Store::snapshot(const std::function<Result<void>()>& body) const {
  return impl_->database.snapshot(body);
}

Result<std::optional<CampaignId>> Store::latest_campaign() const {
  const auto id = impl_->database.integer("SELECT max(id) FROM campaign");
  if (!id) return tl::unexpected(id.error());
  return *id == 0 ? std::nullopt : std::optional(CampaignId{*id});
}

Result<std::vector<EventInsert>> Store::events(CampaignId campaign) const {
  std::vector<EventInsert> events;
  const auto read = for_each_row(
      impl_->database,
      "SELECT t_ns, utc_ns, severity, kind, text FROM event WHERE campaign_id = ? ORDER BY id",
      [&](const Statement& row) {
        events.push_back({row.integer(0), row.integer(1), row.text(2), row.text(3), row.text(4)});
      },
      key(campaign));
  if (!read) return tl::unexpected(read.error());
  return events;
}

Result<std::vector<MonitorInsert>> Store::monitor_before(BoardId board, std::int64_t t_ns) const {
  std::vector<MonitorInsert> rows;
  const auto read = for_each_row(
      impl_->database,
      "SELECT t_ns, setpoint_c, chamber_c, board_c, gyro_x_mean_lsb, gyro_y_mean_lsb, "
      "gyro_z_mean_lsb, frames, frames_missing FROM monitor WHERE board_id = ? AND t_ns < ? "
      "ORDER BY t_ns",
      [&](const Statement& row) {
        rows.push_back({board,
                        row.integer(0),
                        row.real(1),
                        row.real(2),
                        row.real(3),
                        {row.real(4), row.real(5), row.real(6)},
                        row.integer(7),
                        row.integer(8)});
      },
      static_cast<std::int64_t>(board), t_ns);
  if (!read) return tl::unexpected(read.error());
  return rows;
}

Result<CampaignRow> Store::campaign(CampaignId campaign) const {
  std::optional<CampaignRow> found;
  const auto read = for_each_row(
      impl_->database, std::string(select_campaign) + "WHERE id = ?",
      [&](const Statement& row) { found = campaign_from(row); }, key(campaign));
  if (!read) return tl::unexpected(read.error());
  if (found) return *found;
  return fail(Errc::unknown_name,
              fmt::format("{}: no campaign {}", impl_->database.path(), key(campaign)),
              "`gyrocal db` lists the campaigns");
}

Result<std::vector<std::pair<BoardId, BoardRow>>> Store::boards(CampaignId campaign) const {
  std::vector<std::pair<BoardId, BoardRow>> boards;
  const auto read = for_each_row(
      impl_->database,
      "SELECT id, name, device, mcu_id, firmware_version, hardware_version, axes, lsb_per_dps_x, "
      "lsb_per_dps_y, lsb_per_dps_z, lsb_per_dps_per_k_x, lsb_per_dps_per_k_y, "
      "lsb_per_dps_per_k_z FROM board WHERE campaign_id = ? ORDER BY id",
      [&](const Statement& row) { boards.emplace_back(BoardId{row.integer(0)}, board_from(row)); },
      key(campaign));
  if (!read) return tl::unexpected(read.error());
  return boards;
}

Result<std::optional<OpenCampaign>> Store::open_campaign() const {
  std::optional<OpenCampaign> open;
  auto read =
      for_each_row(impl_->database,
                   std::string(select_campaign) +
                       "WHERE state NOT IN ('finished', 'aborted') ORDER BY id DESC LIMIT 1",
                   [&](const Statement& row) {
                     open = OpenCampaign{CampaignId{row.integer(0)}, campaign_from(row), 0, {}, {}};
                   });
  if (!read) return tl::unexpected(read.error());
  if (!open) return open;
  auto found = boards(open->id);
  if (!found) return tl::unexpected(found.error());
  open->boards = std::move(*found);
  auto attempts = dwells(open->id);
  if (!attempts) return tl::unexpected(attempts.error());
  open->dwells = std::move(*attempts);
  read = for_each_row(
      impl_->database, t_last, [&](const Statement& row) { open->t_last_ns = row.integer(0); },
      key(open->id));
  if (!read) return tl::unexpected(read.error());
  return open;
}

Result<std::vector<DwellRow>> Store::dwells(CampaignId campaign) const {
  std::vector<DwellRow> dwells;
  const auto read = for_each_row(
      impl_->database, select_dwells,
      [&](const Statement& row) { dwells.push_back(dwell_from(row)); }, key(campaign));
  if (!read) return tl::unexpected(read.error());
  return dwells;
}

Result<std::vector<AcceptedDwell>> Store::accepted_dwells(CampaignId campaign,
                                                          BoardId board) const {
  std::vector<AcceptedDwell> dwells;
  const auto read = for_each_row(
      impl_->database,
      "SELECT dwell.id, dwell.ordinal, setpoint_c, chamber_mean_c, board_mean_c FROM dwell "
      "JOIN setpoint USING (campaign_id, ordinal) "
      "WHERE dwell.campaign_id = ? AND board_id = ? AND reject_reason IS NULL ORDER BY ordinal",
      [&](const Statement& row) {
        dwells.push_back({DwellId{row.integer(0)}, static_cast<int>(row.integer(1)),
                          Celsius{row.real(2)}, row.real(3), row.real(4)});
      },
      key(campaign), key(board));
  if (!read) return tl::unexpected(read.error());
  return dwells;
}

Result<std::vector<BoardSample>> Store::samples(DwellId dwell) const {
  std::vector<BoardSample> samples;
  std::int64_t counter_first = 0;
  const auto dwell_read = for_each_row(
      impl_->database, "SELECT samples, coalesce(counter_first, 0) FROM dwell WHERE id = ?",
      [&](const Statement& row) {
        samples.reserve(static_cast<std::size_t>(row.integer(0)));
        counter_first = row.integer(1);
      },
      key(dwell));
  if (!dwell_read) return tl::unexpected(dwell_read.error());
  const auto read = for_each_row(
      impl_->database, select_samples,
      [&](const Statement& row) { samples.push_back(sample_from(row, counter_first)); },
      key(dwell));
  if (!read) return tl::unexpected(read.error());
  return samples;
}

Result<std::optional<AnalysisSettings>> Store::analysis_settings(CampaignId campaign) const {
  std::optional<AnalysisSettings> settings;
  const auto read = for_each_row(
      impl_->database,
      fmt::format("SELECT settings_json, software_version FROM analysis WHERE id = {}",
                  latest_analysis),
      [&](const Statement& row) {
        settings = AnalysisSettings{row.text(0), row.text(1)};
      },
      key(campaign));
  if (!read) return tl::unexpected(read.error());
  return settings;
}

Result<std::vector<DwellDriftInsert>> Store::drifts(CampaignId campaign, BoardId board,
                                                    Axis axis) const {
  std::vector<DwellDriftInsert> drifts;
  const auto read = for_each_row(
      impl_->database,
      fmt::format("SELECT dwell_id, raw_mean_dps, raw_sd_dps, filtered_mean_dps, filtered_sd_dps, "
                  "standard_error_dps FROM dwell_drift JOIN dwell ON dwell.id = dwell_id "
                  "WHERE analysis_id = {} AND board_id = ? AND axis = ? ORDER BY ordinal",
                  latest_analysis),
      [&](const Statement& row) {
        drifts.push_back({DwellId{row.integer(0)}, axis, row.real(1), row.real(2), row.real(3),
                          row.real(4), row.real(5)});
      },
      key(campaign), key(board), name_of(axis));
  if (!read) return tl::unexpected(read.error());
  return drifts;
}

Result<std::vector<ModelInsert>> Store::models(CampaignId campaign, BoardId board,
                                               Axis axis) const {
  std::vector<ModelInsert> models;
  std::vector<std::int64_t> ids;
  auto read = for_each_row(
      impl_->database,
      fmt::format(
          "SELECT id, method, parameters_json, rmse_dps, rmse_n_minus_1_dps, mae_dps, "
          "max_dps, loocv_rmse_dps, block_rmse_dps, effective_parameters, recommended, reason, "
          "warnings, dwells_sha256 FROM model "
          "WHERE analysis_id = {} AND board_id = ? AND axis = ? ORDER BY id",
          latest_analysis),
      [&](const Statement& row) {
        ids.push_back(row.integer(0));
        models.push_back(model_from(row, board, axis));
      },
      key(campaign), key(board), name_of(axis));
  for (std::size_t i = 0; i < ids.size() && read; ++i) {
    read = for_each_row(
        impl_->database, "SELECT dwell_id FROM model_dwell WHERE model_id = ? ORDER BY position",
        [&](const Statement& row) { models[i].dwells.push_back(DwellId{row.integer(0)}); }, ids[i]);
    if (!read) break;
    read = for_each_row(
        impl_->database,
        "SELECT temperature_c, measured_dps, fitted_dps, band_dps FROM model_point WHERE model_id "
        "= ? "
        "ORDER BY position",
        [&](const Statement& row) {
          models[i].points.push_back({row.real(0), row.real(1), row.real(2), row.real(3)});
        },
        ids[i]);
  }
  if (!read) return tl::unexpected(read.error());
  return models;
}

}  // namespace gyrocal
