#include "compensation/discrepancy/session_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "compensation/discrepancy/sample_rows.h"

namespace gyrocal {
namespace {

constexpr double rate_tolerance = 0.05;
constexpr double gap_s_max = 1800;  // the record may have a gap at its end, as anywhere

Result<void> check_head(const Session& session) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(session.sample_rate_hz)) {
    return fail(Errc::out_of_range,
                fmt::format("session.json: sample_rate_hz is {}, expected a number > 0",
                            session.sample_rate_hz));
  }
  if (!positive(session.monitor_interval_s)) {
    return fail(Errc::out_of_range,
                fmt::format("session.json: monitor_interval_s is {}, expected a number > 0",
                            session.monitor_interval_s));
  }
  if (session.dwells.empty()) {
    return fail(Errc::too_few_points, "session.json: no dwells",
                "a session needs the samples of at least one dwell");
  }
  for (std::size_t i = 1; i < session.dwells.size(); ++i) {
    if (session.dwells[i].t_start_s <= session.dwells[i - 1].t_start_s) {
      return fail(Errc::bad_input,
                  fmt::format("session.json: dwell {} starts at {} s, not after dwell {} at {} s",
                              session.dwells[i].dwell, session.dwells[i].t_start_s,
                              session.dwells[i - 1].dwell, session.dwells[i - 1].t_start_s));
    }
  }
  return {};
}

Result<void> check_monitor(const Session& session) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < session.monitor.size(); ++i) {
    const MonitorRow& row = session.monitor[i];
    const std::size_t line = i + 2;
    if (!std::isfinite(row.t_s)) {
      return fail(Errc::not_finite, fmt::format("monitor.csv:{}: t_s is not a number", line));
    }
    if (i > 0 && row.t_s <= session.monitor[i - 1].t_s) {
      return fail(Errc::bad_input,
                  fmt::format("monitor.csv:{}: t_s is {} after {}: time stands or runs backwards",
                              line, row.t_s, session.monitor[i - 1].t_s),
                  "rows must ascend in time, each time once");
    }
    for (const double value : {row.gyro_dps, row.chamber_c, row.board_c, row.setpoint_c}) {
      if (std::isinf(value)) {
        return fail(Errc::not_finite, fmt::format("monitor.csv:{}: an infinite value", line));
      }
    }
    if (std::isnan(row.gyro_dps)) continue;
    low = std::min(low, row.gyro_dps);
    high = std::max(high, row.gyro_dps);
  }
  if (rows_with_gyro(session) >= monitor_rows_min && low == high) {
    return fail(Errc::bad_input,
                fmt::format("monitor.csv: gyro_z_dps is {} in every row: a constant column", low),
                "was the board streaming?");
  }
  return {};
}

Result<void> check_dwells_inside(const Session& session) {
  if (session.monitor.empty()) return {};
  const double first = session.monitor.front().t_s - gap_s_max;
  const double last = session.monitor.back().t_s + gap_s_max;
  for (const SessionDwell& dwell : session.dwells) {
    if (dwell.t_start_s < first || dwell.t_start_s > last) {
      return fail(Errc::bad_input,
                  fmt::format("session.json: dwell {} starts at {} s, outside the record of "
                              "monitor.csv ({} to {} s)",
                              dwell.dwell, dwell.t_start_s, session.monitor.front().t_s,
                              session.monitor.back().t_s),
                  "are the dwells' times on the same clock as the monitor's?");
    }
  }
  return {};
}

Result<void> check_samples(const Session& session) {
  struct Last {
    double t_s;
    std::int64_t seq;
  };
  std::map<int, Last> last;
  std::vector<double> steps;
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    const SessionSample& sample = session.samples[i];
    const std::size_t line = i + 2;
    if (std::isinf(sample.gyro_dps) || !std::isfinite(sample.t_s)) {
      return fail(Errc::not_finite, fmt::format("samples.csv:{}: a value is not finite", line));
    }
    const auto found = last.find(sample.dwell);
    if (found != last.end()) {
      if (sample.seq <= found->second.seq) {
        return fail(
            Errc::bad_input,
            fmt::format("samples.csv:{}: seq {} of dwell {} after {}: a duplicate or out of "
                        "order",
                        line, sample.seq, sample.dwell, found->second.seq));
      }
      if (sample.t_s < found->second.t_s) {
        return fail(
            Errc::bad_input,
            fmt::format("samples.csv:{}: t_s runs backwards within dwell {}", line, sample.dwell));
      }
      if (sample.seq == found->second.seq + 1) steps.push_back(sample.t_s - found->second.t_s);
    }
    last[sample.dwell] = {sample.t_s, sample.seq};
    if (std::isnan(sample.gyro_dps)) continue;
    low = std::min(low, sample.gyro_dps);
    high = std::max(high, sample.gyro_dps);
  }
  if (session.samples.size() < 64) {
    return fail(Errc::too_few_points, fmt::format("samples.csv: {} samples, expected at least 64",
                                                  session.samples.size()));
  }
  if (low == high) {
    return fail(Errc::bad_input,
                fmt::format("samples.csv: gyro_z_dps is {} in every row: a constant column", low));
  }
  double mean = 0;
  for (const double step : steps) mean += step / static_cast<double>(steps.size());
  if (!steps.empty() && std::abs(mean * session.sample_rate_hz - 1) > rate_tolerance) {
    return fail(Errc::bad_input,
                fmt::format("samples.csv: samples follow each other every {:.4g} s ({:.4g} Hz), "
                            "session.json says sample_rate_hz = {:.4g}",
                            mean, 1 / mean, session.sample_rate_hz),
                "one of the two is wrong; correct it before a verdict");
  }
  return {};
}

/// One count of the converter is 0.2 deg/s on these boards; radians would make everything 57 times
/// smaller, millidegrees 1000 times larger.
Result<void> check_units(const Session& session) {
  if (!(session.lsb_dps > 0)) return {};
  double square = 0, n = 0;
  std::map<double, int> distinct;
  for (std::size_t i = 1; i < session.samples.size() && i < 20'000; ++i) {
    const double d = session.samples[i].gyro_dps - session.samples[i - 1].gyro_dps;
    if (std::isnan(d)) continue;
    square += d * d, n += 1;
    if (d != 0) ++distinct[std::abs(d)];
  }
  if (n < 32 || distinct.empty()) return {};
  const double smallest = distinct.begin()->first;
  const double ratio = session.lsb_dps / smallest;
  constexpr double degrees_per_radian = 57.29577951308232;
  if (std::abs(ratio / degrees_per_radian - 1) < 0.01) {
    return fail(Errc::bad_input,
                fmt::format("samples.csv: the smallest step of gyro_z_dps is {:.4g}, which is "
                            "lsb_dps = {:.4g} divided by 57.3: the values look like radians per "
                            "second",
                            smallest, session.lsb_dps),
                "multiply the column by 180/pi");
  }
  return {};
}

}  // namespace

Result<void> check_session(const Session& session) {
  for (const auto check :
       {check_head, check_monitor, check_dwells_inside, check_samples, check_units}) {
    if (auto checked = check(session); !checked) return checked;
  }
  return {};
}

Result<void> check_rows(const Session& session) {
  const std::size_t rows = rows_with_gyro(session);
  if (rows >= monitor_rows_min) return {};
  return fail(Errc::too_few_points,
              fmt::format("monitor.csv: {} rows with a gyro mean, expected at least {}, and the "
                          "samples hold no more",
                          rows, monitor_rows_min),
              "the slow stream is what tells effects apart; record it through ramps too");
}

}  // namespace gyrocal
