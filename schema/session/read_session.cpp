#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "config/text_file.h"
#include "schema/session/csv_rows.h"
#include "schema/session/session_checks.h"
#include "schema/session/session_csv.h"
#include "schema/session/session_json.h"

namespace gyrocal {
namespace {

constexpr CsvColumn monitor_columns[] = {
    {"t_s", true}, {"setpoint_c"}, {"chamber_c"}, {"board_c"}, {"gyro_z_dps"}};

constexpr CsvColumn sample_columns[] = {{"dwell", true}, {"seq", true}, {"t_s", true},
                                        {"gyro_z_dps"},  {"acc_x_g"},   {"acc_y_g"},
                                        {"acc_z_g"},     {"board_c"},   {"chamber_c"}};

Result<std::vector<MonitorRow>> parse_monitor(const std::string& text, const std::string& source) {
  auto rows = CsvRows::start(text, source, monitor_columns);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<MonitorRow> monitor;
  std::array<double, std::size(monitor_columns)> v{};
  for (;;) {
    const auto more = rows->next(v);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    if (!monitor.empty() && v[0] <= monitor.back().t_s) {
      return v[0] == monitor.back().t_s
                 ? rows->refuse(0, fmt::format("{} s stands twice", v[0]))
                 : rows->refuse(0, fmt::format("{} s after {} s: time runs backwards", v[0],
                                               monitor.back().t_s));
    }
    monitor.push_back({v[0], v[1], v[2], v[3], v[4]});
  }
  return monitor;
}

/// The order within a dwell, and each dwell in one block.
class SampleOrder {
 public:
  explicit SampleOrder(const std::vector<SessionDwell>& dwells) {
    for (const SessionDwell& dwell : dwells) state_[dwell.dwell] = State::expected;
  }

  Result<void> check(const CsvRows& rows, const SessionSample& next, const SessionSample* last) {
    if (last == nullptr || last->dwell != next.dwell) return begin_block(rows, next, last);
    if (next.seq == last->seq) {
      return rows.refuse(1, fmt::format("seq {} of dwell {} stands twice", next.seq, next.dwell));
    }
    if (next.seq < last->seq) {
      return rows.refuse(1, fmt::format("{} after {}: seq runs backwards", next.seq, last->seq));
    }
    if (next.t_s < last->t_s) {
      return rows.refuse(2,
                         fmt::format("{} s after {} s: time runs backwards", next.t_s, last->t_s));
    }
    return {};
  }

 private:
  enum class State { expected, seen };
  Result<void> begin_block(const CsvRows& rows, const SessionSample& next,
                           const SessionSample* last) {
    const auto found = state_.find(next.dwell);
    if (found == state_.end()) {
      return rows.refuse(0, fmt::format("dwell {} is not listed in session.json", next.dwell));
    }
    if (found->second == State::seen) {
      return rows.refuse(0, fmt::format("dwell {} again, after dwell {}", next.dwell, last->dwell));
    }
    found->second = State::seen;
    return {};
  }
  std::map<std::int32_t, State> state_;
};

Result<std::vector<SessionSample>> parse_samples(const std::string& text, const std::string& source,
                                                 const std::vector<SessionDwell>& dwells) {
  auto rows = CsvRows::start(text, source, sample_columns);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<SessionSample> samples;
  samples.reserve(text.size() / 40);
  SampleOrder order(dwells);
  std::array<double, std::size(sample_columns)> v{};
  for (;;) {
    const auto more = rows->next(v);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    const auto dwell = rows->whole(0, v[0]);
    if (!dwell) return tl::unexpected(dwell.error());
    const auto seq = rows->whole(1, v[1]);
    if (!seq) return tl::unexpected(seq.error());
    const SessionSample sample{
        static_cast<std::int32_t>(*dwell), *seq, v[2], v[3], {v[4], v[5], v[6]}, v[7], v[8]};
    const auto in_order = order.check(*rows, sample, samples.empty() ? nullptr : &samples.back());
    if (!in_order) return tl::unexpected(in_order.error());
    samples.push_back(sample);
  }
  if (samples.empty()) return fail(Errc::bad_input, source + ": no rows below the header");
  return samples;
}

/// Blocks of dwells in time order; within a block the order holds already.
void sort_blocks(std::vector<SessionSample>& samples) {
  std::map<std::int32_t, double> begins;
  bool sorted = true;
  for (const SessionSample& sample : samples) begins.try_emplace(sample.dwell, sample.t_s);
  for (std::size_t i = 1; i < samples.size(); ++i) sorted &= samples[i - 1].t_s <= samples[i].t_s;
  if (sorted) return;
  std::stable_sort(samples.begin(), samples.end(),
                   [&](const SessionSample& a, const SessionSample& b) {
                     return begins.at(a.dwell) < begins.at(b.dwell);
                   });
}

}  // namespace

Result<Session> read_session(const std::string& folder) {
  const auto file = [&folder](const char* name) { return folder + "/" + name; };
  const auto head = read_text_file(file("session.json"));
  if (!head) return tl::unexpected(head.error());
  auto session = parse_session_json(*head, file("session.json"));
  if (!session) return session;

  const auto monitor_text = read_text_file(file("monitor.csv"));
  if (!monitor_text) return tl::unexpected(monitor_text.error());
  auto monitor = parse_monitor(*monitor_text, file("monitor.csv"));
  if (!monitor) return tl::unexpected(monitor.error());
  session->monitor = std::move(*monitor);

  const auto samples_text = read_text_file(file("samples.csv"));
  if (!samples_text) return tl::unexpected(samples_text.error());
  auto samples = parse_samples(*samples_text, file("samples.csv"), session->dwells);
  if (!samples) return tl::unexpected(samples.error());
  session->samples = std::move(*samples);
  sort_blocks(session->samples);

  if (auto error = contradiction_in(*session, folder)) return tl::unexpected(*error);
  return session;
}

}  // namespace gyrocal
