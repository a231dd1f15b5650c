#include "schema/session/import_session.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

std::size_t axis_of(const Session& session) {
  return session.axis == "x" ? 0 : session.axis == "y" ? 1 : 2;
}

std::int64_t nanoseconds(double t_s) { return std::llround(t_s * 1e9); }

/// Mean and span of what is measured of a column.
class Span {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    ++count_;
  }
  double mean() const { return count_ > 0 ? sum_ / count_ : missing; }
  double peak_to_peak() const { return count_ > 0 ? high_ - low_ : missing; }

 private:
  double sum_ = 0;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  int count_ = 0;
};

/// One dwell as the store takes it, its samples beside it.
struct Converted {
  DwellRow dwell;
  std::vector<BoardSample> samples;
};

Result<std::int16_t> whole_count(const Session& session, const SessionSample& sample,
                                 const ImportNames& names) {
  constexpr double tolerance = 0.02;  // lsb_dps may have been printed with four digits
  const double count = sample.gyro_dps / session.lsb_dps;
  if (std::abs(count - std::round(count)) <= tolerance && std::abs(count) <= 32767) {
    return static_cast<std::int16_t>(std::lround(count));
  }
  return fail(
      Errc::bad_input,
      fmt::format("{}: dwell {}, seq {}: {} deg/s is {:.3f} counts of lsb_dps = {}, "
                  "expected a whole number up to 32767",
                  names.source, sample.dwell, sample.seq, sample.gyro_dps, count, session.lsb_dps),
      "the database holds raw counts; the directory can be read without an import");
}

Result<Converted> convert_dwell(const Session& session, const SessionDwell& from,
                                const ImportNames& names) {
  if (std::isnan(from.setpoint_c)) {
    return fail(Errc::bad_input,
                fmt::format("{}: dwell {} has no setpoint_c", names.source, from.dwell));
  }
  Converted to;
  Span board;
  Span chamber;
  to.dwell.t_start_ns = nanoseconds(from.t_start_s);
  to.dwell.t_end_ns = to.dwell.t_start_ns;
  std::int64_t last_seq = -1;
  for (const SessionSample& sample : session.samples) {
    if (sample.dwell != from.dwell || std::isnan(sample.gyro_dps)) continue;
    const auto count = whole_count(session, sample, names);
    if (!count) return tl::unexpected(count.error());
    BoardSample raw;
    raw.t_ns = nanoseconds(sample.t_s);
    raw.counter = static_cast<std::uint32_t>(sample.seq);
    raw.gyro_lsb.at(axis_of(session)) = *count;
    if (std::abs(sample.board_c) < 127) {  // not if missing
      raw.temperature_raw = static_cast<std::int16_t>(std::lround(sample.board_c * 256));
    }
    board.add(sample.board_c);
    chamber.add(sample.chamber_c);
    to.dwell.t_end_ns = std::max(to.dwell.t_end_ns, raw.t_ns);
    to.dwell.frames_missing += sample.seq - last_seq - 1;
    last_seq = sample.seq;
    to.samples.push_back(raw);
  }
  to.dwell.soak_s = missing;
  to.dwell.chamber_mean_c = chamber.mean();
  to.dwell.chamber_peak_to_peak_k = chamber.peak_to_peak();
  to.dwell.board_mean_c = board.mean();
  return to;
}

CampaignRow campaign_of(const Session& session, const ImportNames& names) {
  CampaignRow row;
  row.name = names.campaign;
  row.config_toml = "# imported from " + names.source + "\n";
  row.software_version = names.software_version;
  row.samples_per_setpoint = std::max(session.samples_per_dwell, 1);
  row.sample_rate_hz = session.sample_rate_hz;
  row.monitor_interval_s = session.monitor_interval_s;
  row.state = std::string("aborted");  // until all of it is stored
  return row;
}

BoardRow board_of(const Session& session, const ImportNames& names) {
  BoardRow row;
  row.name = session.device.empty() ? std::string("board") : session.device;
  row.device = names.source;
  row.lsb_per_dps.fill(1 / session.lsb_dps);
  row.measured.fill(false);
  row.measured.at(axis_of(session)) = true;
  return row;
}

std::vector<MonitorInsert> monitor_of(const Session& session, BoardId board) {
  std::vector<MonitorInsert> rows;
  const auto frames = std::llround(session.monitor_interval_s * session.sample_rate_hz);
  for (const MonitorRow& from : session.monitor) {
    MonitorInsert row;
    row.board = board;
    row.t_ns = nanoseconds(from.t_s);
    row.setpoint_c = from.setpoint_c;
    row.chamber_c = from.chamber_c;
    row.board_c = from.board_c;
    row.gyro_mean_lsb.at(axis_of(session)) = from.gyro_dps / session.lsb_dps;
    row.frames = std::isnan(from.gyro_dps) ? 0 : frames;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

Result<CampaignId> import_session(Store& store, const Session& session, const ImportNames& names) {
  std::vector<Converted> converted;
  std::vector<SetpointRow> setpoints;
  for (const SessionDwell& from : session.dwells) {
    auto dwell = convert_dwell(session, from, names);
    if (!dwell) return tl::unexpected(dwell.error());
    dwell->dwell.ordinal = static_cast<int>(converted.size());
    setpoints.push_back({dwell->dwell.ordinal, {from.setpoint_c}});
    converted.push_back(std::move(*dwell));
  }
  const auto campaign = store.begin_campaign(campaign_of(session, names), setpoints);
  if (!campaign) return campaign;
  const auto board = store.add_board(*campaign, board_of(session, names));
  if (!board) return tl::unexpected(board.error());
  std::vector<DwellWithSamples> group;
  for (Converted& dwell : converted) {
    dwell.dwell.board = *board;
    group.push_back({dwell.dwell, dwell.samples});
  }
  const auto dwells = store.add_group(*campaign, group);
  if (!dwells) return tl::unexpected(dwells.error());
  auto done = store.add_monitor(*campaign, monitor_of(session, *board));
  if (done) done = store.set_campaign_state(*campaign, "finished");
  if (!done) return tl::unexpected(done.error());
  return campaign;
}

}  // namespace gyrocal
