#include "schema/session/session_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gyrocal {
namespace {

/// How far the monitor's record reaches: a gap of half an hour may lie at its ends as anywhere.
struct Record {
  double begin_s;
  double end_s;
};

Record record_of(const Session& session) {
  constexpr double gap_s_max = 1800;
  const double slack_s = gap_s_max + 2 * session.monitor_interval_s +
                         std::max(session.samples_per_dwell, 1) / session.sample_rate_hz;
  return {session.monitor.front().t_s - slack_s, session.monitor.back().t_s + slack_s};
}

std::optional<Error> dwell_outside_record(const Session& session, const std::string& folder) {
  if (session.monitor.empty()) return std::nullopt;
  const Record record = record_of(session);
  const auto outside = [&](int dwell, double t_s, const char* file, const char* what) {
    return Error{Errc::bad_input,
                 fmt::format("{}/{}: dwell {} {} at {} s, outside the record in monitor.csv, {} to "
                             "{} s",
                             folder, file, dwell, what, t_s, session.monitor.front().t_s,
                             session.monitor.back().t_s),
                 "do both files count from the same start?"};
  };
  for (const SessionDwell& dwell : session.dwells) {
    if (!(dwell.t_start_s >= record.begin_s && dwell.t_start_s <= record.end_s)) {
      return outside(dwell.dwell, dwell.t_start_s, "session.json", "starts");
    }
  }
  for (const SessionSample& sample : session.samples) {
    if (!(sample.t_s >= record.begin_s && sample.t_s <= record.end_s)) {
      return outside(sample.dwell, sample.t_s, "samples.csv", "has a sample");
    }
  }
  return std::nullopt;
}

/// Samples a second of each dwell that is long enough to tell.
std::vector<double> rates_hz(const Session& session) {
  constexpr double enough = 10;  // below it the jitter of host times could pass for another rate
  std::vector<double> rates;
  const auto& samples = session.samples;
  for (std::size_t first = 0, end = 0; first < samples.size(); first = end) {
    while (end < samples.size() && samples[end].dwell == samples[first].dwell) ++end;
    const double steps = static_cast<double>(samples[end - 1].seq - samples[first].seq);
    const double lasted_s = samples[end - 1].t_s - samples[first].t_s;
    if (steps >= enough) rates.push_back(steps / lasted_s);  // all at once: an infinite rate
  }
  return rates;
}

std::optional<Error> contradicted_rate(const Session& session, const std::string& folder) {
  constexpr double tolerance = 0.1;  // a crystal is off by 1e-4, a firmware loses a few ticks
  auto rates = rates_hz(session);
  if (rates.empty()) return std::nullopt;
  const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
  std::nth_element(rates.begin(), middle, rates.end());
  if (std::abs(*middle / session.sample_rate_hz - 1) <= tolerance) return std::nullopt;
  return Error{Errc::bad_input,
               fmt::format("{}/session.json: sample_rate_hz = {}, but seq and t_s in samples.csv "
                           "say {:.6g} Hz",
                           folder, session.sample_rate_hz, *middle),
               "correct the one that is wrong"};
}

}  // namespace

std::optional<Error> contradiction_in(const Session& session, const std::string& folder) {
  if (auto error = dwell_outside_record(session, folder)) return error;
  return contradicted_rate(session, folder);
}

}  // namespace gyrocal
