#include "compensation/discrepancy/sample_rows.h"

#include <algorithm>
#include <cmath>

namespace gyrocal {
namespace {

constexpr double row_s_max = 1;
constexpr double rows_wanted = 64;
constexpr double samples_per_row_min = 4;
constexpr double pause_rows = 4;  // more without a sample is a pause

/// Mean of what is there of a column.
class Mean {
 public:
  void add(double value) {
    if (!std::isnan(value)) sum_ += value, ++count_;
  }
  [[nodiscard]] double value() const {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : missing;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

/// Samples of one row.
struct Part {
  double begin_s;
  double setpoint_c;
  Mean gyro_dps, board_c, chamber_c;
};

double setpoint_of(const Session& session, int dwell) {
  const auto found = std::find_if(session.dwells.begin(), session.dwells.end(),
                                  [&](const SessionDwell& d) { return d.dwell == dwell; });
  return found == session.dwells.end() ? missing : found->setpoint_c;
}

std::vector<Part> parts_of(const Session& session, double interval_s) {
  std::vector<Part> parts;
  int dwell = 0;
  for (const SessionSample& sample : session.samples) {
    const bool next =
        parts.empty() || sample.dwell != dwell || sample.t_s >= parts.back().begin_s + interval_s;
    dwell = sample.dwell;
    if (next) parts.push_back({sample.t_s, setpoint_of(session, dwell), {}, {}, {}});
    parts.back().gyro_dps.add(sample.gyro_dps);
    parts.back().board_c.add(sample.board_c);
    parts.back().chamber_c.add(sample.chamber_c);
  }
  return parts;
}

}  // namespace

std::size_t rows_with_gyro(const Session& session) {
  return static_cast<std::size_t>(
      std::count_if(session.monitor.begin(), session.monitor.end(),
                    [](const MonitorRow& row) { return !std::isnan(row.gyro_dps); }));
}

Session with_rows_of_samples(const Session& session) {
  Session made = session;
  const double recorded_s = static_cast<double>(session.samples.size()) / session.sample_rate_hz;
  made.monitor_interval_s = std::max(std::min(row_s_max, recorded_s / rows_wanted),
                                     samples_per_row_min / session.sample_rate_hz);
  made.monitor.clear();
  const double full = made.monitor_interval_s * session.sample_rate_hz;
  for (const Part& part : parts_of(session, made.monitor_interval_s)) {
    if (static_cast<double>(part.gyro_dps.count()) < full / 2) continue;
    const MonitorRow row{part.begin_s + made.monitor_interval_s / 2, part.setpoint_c,
                         part.chamber_c.value(), part.board_c.value(), part.gyro_dps.value()};
    const double last_s = made.monitor.empty() ? row.t_s : made.monitor.back().t_s;
    if (row.t_s - last_s > pause_rows * made.monitor_interval_s) {
      made.monitor.push_back(
          {(last_s + row.t_s) / 2, row.setpoint_c, row.chamber_c, missing, missing});
    }
    made.monitor.push_back(row);
  }
  return made;
}

std::optional<Session> stand_in_for(const Session& recorded) {
  if (rows_with_gyro(recorded) >= monitor_rows_min) return std::nullopt;
  return with_rows_of_samples(recorded);
}

}  // namespace gyrocal
