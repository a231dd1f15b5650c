#include "daemon/runner/progress.h"

#include <fmt/core.h>

#include <cstdio>

namespace gyrocal::runner {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds{200};
constexpr int bar_width = 25;

}  // namespace

std::string clock_text(Duration t) {
  const auto total = std::chrono::duration_cast<std::chrono::seconds>(t).count();
  return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (line_shown_) fmt::print(stderr, "\r\033[K");
  line_shown_ = false;
}

void Progress::show(const EventInsert& event) {
  clear();
  const std::string kind = event.kind == "transition" ? "" : event.kind + ": ";
  const std::string severity = event.severity == "info" ? "" : event.severity + ": ";
  fmt::print(stderr, "{:>9}  {}{}{}\n", clock_text(Duration{event.t_ns}), severity, kind,
             event.text);
}

void Progress::show(const Snapshot& now) {
  if (!on_terminal_) return;
  const auto wall = std::chrono::steady_clock::now();  // how often to redraw, nothing else
  if (wall < next_) return;
  next_ = wall + redraw_interval;
  const double share =
      now.setpoints > 0
          ? (double(now.setpoints_done) + now.dwell_share.value_or(0)) / double(now.setpoints)
          : 0;
  const int filled = static_cast<int>(share * bar_width);
  std::string line = fmt::format("{:>9}  [{}{}] {}/{}  {}", clock_text(now.t),
                                 std::string(static_cast<std::size_t>(filled), '#'),
                                 std::string(static_cast<std::size_t>(bar_width - filled), '.'),
                                 now.setpoints_done, now.setpoints, now.state);
  if (now.air) line += fmt::format("  {:.1f} degC", now.air->value);
  if (now.setpoint) line += fmt::format(" -> {:.1f}", now.setpoint->value);
  if (now.dwell_share) line += fmt::format("  dwell {:.0f} %", *now.dwell_share * 100);
  line += fmt::format("  {} left", clock_text(now.left));
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
  line_shown_ = true;
}

}  // namespace gyrocal::runner
