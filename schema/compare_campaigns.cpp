#include "schema/compare_campaigns.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "schema/close_cells.h"
#include "schema/store_impl.h"

namespace gyrocal {
namespace {

/// How the rows of a part are listed: time, `keys` columns that name the row, what it holds.
/// ?1: campaign (of the slow stream: board), ?2: after, ?3: to. What an analysis stores has no
/// time: it is listed in windows without an end.
struct Listing {
  const char* row;
  int keys;
  const char* sql;
  int later = 0;  ///< so many of the last columns came with a later schema
};

constexpr Listing events{"event", 0,
                         "SELECT t_ns, severity, kind, text, utc_ns FROM event WHERE "
                         "campaign_id = ?1 AND t_ns > ?2 AND t_ns <= ?3 ORDER BY id"};
constexpr Listing dwells{
    "dwell", 3,
    "SELECT t_end_ns, board.name AS board, ordinal AS setpoint, attempt, t_start_ns, t_end_ns, "
    "soak_s, timed_soak, chamber_mean_c, chamber_peak_to_peak_k, board_mean_c, samples, "
    "frames_missing, counter_first, reject_reason FROM dwell JOIN board ON board.id = board_id "
    "WHERE dwell.campaign_id = ?1 AND t_end_ns > ?2 AND t_end_ns <= ?3 ORDER BY dwell.id"};
constexpr Listing samples{
    "sample", 4,
    "SELECT sample.t_ns, board.name AS board, ordinal AS setpoint, attempt, seq, sample.t_ns, "
    "gyro_x_lsb, gyro_y_lsb, gyro_z_lsb, temperature_raw, counter FROM dwell JOIN board ON "
    "board.id = board_id JOIN sample ON dwell_id = dwell.id WHERE dwell.campaign_id = ?1 AND "
    "t_end_ns > ?2 AND t_end_ns <= ?3 ORDER BY dwell.id, seq"};
constexpr Listing monitor{
    "slow stream", 1,
    "SELECT t_ns, board.name AS board, t_ns, setpoint_c, chamber_c, board_c, gyro_x_mean_lsb, "
    "gyro_y_mean_lsb, gyro_z_mean_lsb, frames, frames_missing FROM board JOIN monitor ON "
    "board_id = board.id WHERE board.id = ?1 AND t_ns > ?2 AND t_ns <= ?3 "
    "ORDER BY t_ns"};
constexpr Listing drifts{
    "zero drift", 3,
    "SELECT t_end_ns, board.name AS board, ordinal AS setpoint, axis, raw_mean_dps, raw_sd_dps, "
    "filtered_mean_dps, filtered_sd_dps, standard_error_dps FROM dwell_drift JOIN dwell ON "
    "dwell.id = dwell_id JOIN board ON board.id = board_id WHERE analysis_id = (SELECT max(id) "
    "FROM analysis WHERE campaign_id = ?1) AND t_end_ns > ?2 AND ?3 = 9223372036854775807 "
    "ORDER BY dwell.id, axis"};
constexpr Listing models{
    "model", 3,
    "SELECT 0, board.name AS board, axis, method, parameters_json, rmse_dps, rmse_n_minus_1_dps, "
    "mae_dps, max_dps, loocv_rmse_dps, recommended, reason, dwells_sha256, block_rmse_dps, "
    "effective_parameters, warnings FROM model JOIN board ON board.id = board_id WHERE analysis_id "
    "= (SELECT max(id) FROM analysis WHERE campaign_id = ?1) AND ?2 < 9223372036854775807 AND "
    "?3 = 9223372036854775807 ORDER BY model.id",
    3};
constexpr Listing model_points{
    "model point", 4,
    "SELECT 0, board.name AS board, axis, method, position, temperature_c, measured_dps, "
    "fitted_dps, band_dps FROM model JOIN board ON board.id = board_id JOIN model_point ON "
    "model_id = model.id WHERE analysis_id = (SELECT max(id) FROM analysis WHERE campaign_id = "
    "?1) AND ?2 < 9223372036854775807 AND ?3 = 9223372036854775807 ORDER BY model.id, position",
    1};

const Listing& listing_of(CampaignPart part) {
  switch (part) {
    case CampaignPart::events:
      return events;
    case CampaignPart::dwells:
      return dwells;
    case CampaignPart::samples:
      return samples;
    case CampaignPart::monitor:
      return monitor;
    case CampaignPart::drifts:
      return drifts;
    case CampaignPart::models:
      return models;
    case CampaignPart::model_points:
      break;
  }
  return model_points;
}

Result<Statement> rows_of(const CampaignWindow& window, const Listing& listing, std::int64_t of) {
  auto rows = window.database.prepare(listing.sql);
  if (rows) rows->bind_all(of, window.after_ns, window.to_ns);
  return rows;
}

std::string text_of(const Statement& row, int column) {
  const Cell cell = row.cell(column);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  return row.is_null(column) ? "nothing" : row.text(column);
}

/// "sample: board left, setpoint 2, attempt 1, seq 17"; without keys, what the row says.
std::string name_of(const Statement& row, const Listing& listing) {
  std::string name = listing.row;
  const int shown = listing.keys > 0 ? listing.keys : row.columns() - 2;
  for (int column = 1; column <= shown; ++column) {
    name += column == 1 ? ": " : ", ";
    if (listing.keys > 0) name += row.column_name(column) + " ";
    name += text_of(row, column);
  }
  return name;
}

/// Whether a row migrated from an earlier schema has nothing in the columns that came later.
bool was_without(const Statement& row, int first_later) {
  for (int column = first_later; column < row.columns(); ++column) {
    if (!row.is_null(column) && !row.text(column).empty()) return false;
  }
  return true;
}

std::optional<RowDifference> difference(const Statement& expected, const Statement& got,
                                        const Listing& listing, double relative) {
  const int first_later = expected.columns() - listing.later;
  const int columns = was_without(expected, first_later) ? first_later : expected.columns();
  for (int column = 0; column < columns; ++column) {
    if (are_close(expected.cell(column), got.cell(column), relative)) continue;
    return RowDifference{expected.integer(0), name_of(expected, listing),
                         expected.column_name(column), text_of(expected, column),
                         text_of(got, column)};
  }
  return std::nullopt;
}

/// Counts the row both statements, or only this one, stand at, and those after it.
Result<std::int64_t> rest_of(Statement& rows) {
  for (std::int64_t count = 1;; ++count) {
    const auto more = rows.next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return count;
  }
}

/// Adds what follows the end of the shorter listing.
Result<void> note_beyond(Statement& longer, bool is_expected, const Listing& listing,
                         PartComparison& comparison) {
  const std::string name = name_of(longer, listing);
  RowDifference beyond{longer.integer(0), name, {}, name, "nothing"};
  if (!is_expected) std::swap(beyond.expected, beyond.got);
  if (!comparison.beyond || beyond.t_ns < comparison.beyond->t_ns) comparison.beyond = beyond;
  const auto rest = rest_of(longer);
  if (!rest) return tl::unexpected(rest.error());
  (is_expected ? comparison.more_expected : comparison.more_got) += *rest;
  return {};
}

/// One listing after the other, into one comparison.
/// @param expected_of, got_of  what ?1 stands for.
Result<void> compare_listing(const CampaignWindow& expected, std::int64_t expected_of,
                             const CampaignWindow& got, std::int64_t got_of, const Listing& listing,
                             double relative, PartComparison& comparison) {
  auto left = rows_of(expected, listing, expected_of);
  if (!left) return tl::unexpected(left.error());
  auto right = rows_of(got, listing, got_of);
  if (!right) return tl::unexpected(right.error());
  for (;;) {
    const auto in_left = left->next();
    if (!in_left) return tl::unexpected(in_left.error());
    const auto in_right = right->next();
    if (!in_right) return tl::unexpected(in_right.error());
    if (!*in_left && !*in_right) return {};
    if (*in_left != *in_right) {
      return note_beyond(*in_left ? *left : *right, *in_left, listing, comparison);
    }
    if (const auto differs = difference(*left, *right, listing, relative)) {
      const auto& first = comparison.difference;
      if (!first || differs->t_ns < first->t_ns) comparison.difference = differs;
      return {};
    }
    ++comparison.rows;
  }
}

/// Board by board: a crash may leave the boards' streams at different ends.
Result<PartComparison> compare_monitor(const CampaignWindow& expected, const CampaignWindow& got,
                                       double relative) {
  const auto left = boards_of(expected.database, expected.campaign);
  if (!left) return tl::unexpected(left.error());
  const auto right = boards_of(got.database, got.campaign);
  if (!right) return tl::unexpected(right.error());
  PartComparison comparison;
  for (std::size_t i = 0; i < std::min(left->size(), right->size()); ++i) {
    auto done =
        compare_listing(expected, (*left)[i], got, (*right)[i], monitor, relative, comparison);
    if (!done) return tl::unexpected(done.error());
  }
  return comparison;
}

}  // namespace

Result<PartComparison> compare_campaigns(const CampaignWindow& expected, const CampaignWindow& got,
                                         CampaignPart part, double relative) {
  if (part == CampaignPart::monitor) return compare_monitor(expected, got, relative);
  PartComparison comparison;
  auto done = compare_listing(expected, key(expected.campaign), got, key(got.campaign),
                              listing_of(part), relative, comparison);
  if (!done) return tl::unexpected(done.error());
  return comparison;
}

Result<std::vector<EventInsert>> events_in(const CampaignWindow& window) {
  std::vector<EventInsert> found;
  auto read = for_each_row(
      window.database, events.sql,
      [&](const Statement& row) {
        found.push_back({row.integer(0), row.integer(4), row.text(1), row.text(2), row.text(3)});
      },
      key(window.campaign), window.after_ns, window.to_ns);
  if (!read) return tl::unexpected(read.error());
  return found;
}

}  // namespace gyrocal
