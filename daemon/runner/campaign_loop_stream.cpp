#include <algorithm>

#include "daemon/runner/campaign_loop.h"

namespace gyrocal::runner {
namespace {

/// Frames of an ended interval still come this late: the parser holds the last one back until the
/// next proves it, and the link has its own latency.
constexpr Duration frames_are_late_by = std::chrono::seconds{2};
/// So much of the chamber's past is kept for dwell means.
constexpr Duration track_kept = std::chrono::minutes{10};

}  // namespace

Result<void> CampaignLoop::note_freeze(std::size_t board) {
  BoardSide& side = boards_[board];
  if (side.frozen || !side.freeze.frozen()) return {};
  side.frozen = true;
  conditions_.sensor_frozen(board, true);
  return journal_.event(
      now(), "warning", "sensor_frozen",
      "board " + plan_.boards[board] +
          ": its temperature stands still while the air moves; it is read at 1 Hz "
          "in breaks before dwells from now on, and soaks are timed");
}

void CampaignLoop::read_frozen_temperatures() {
  for (auto& side : boards_) {
    if (!side.frozen) continue;
    const auto read = side.port.read_temperature(now(), devices_.clock);
    side.break_c = read.value_or(Celsius{missing}).value;
  }
}

Result<void> CampaignLoop::take_intervals(std::size_t board) {
  BoardSide& side = boards_[board];
  side.slow.close_before(now() - std::max(frames_are_late_by, 2 * options_.tick));
  for (auto& interval : side.slow.take()) {
    if (interval.temperatures > 0) {
      conditions_.board_temperature(board, interval.begin + monitor_interval,
                                    Celsius{interval.board_c()});
      side.freeze.board(Celsius{interval.board_c()});
    }
    if (interval.frames > 0) side.latest = interval;
    side.waiting.push_back(interval);
  }
  return note_freeze(board);
}

Result<void> CampaignLoop::write_slow_stream() {
  const Duration t = now();
  const Duration known = track_.latest().value_or(begin_.t);
  const Duration given_up = t - air_is_straight_over - plan_.poll_interval;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (auto taken = take_intervals(i); !taken) return taken;
    auto& waiting = boards_[i].waiting;
    std::size_t written = 0;
    for (; written < waiting.size(); ++written) {
      const Duration end = waiting[written].begin + monitor_interval;
      if (end > known && end > given_up) break;
      if (auto done = write_interval(boards_[i], waiting[written]); !done) return done;
    }
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(written));
  }
  const Duration oldest = collector_.running() ? collector_.began() : t;
  track_.forget_before(std::min(oldest, t) - track_kept);
  return {};
}

Result<void> CampaignLoop::write_interval(const BoardSide& side, const SlowInterval& interval) {
  const Duration centre = interval.begin + monitor_interval / 2;
  MonitorInsert row;
  row.board = side.id;
  row.t_ns = centre.count();
  row.setpoint_c = track_.setpoint(centre).value_or(Celsius{missing}).value;
  row.chamber_c = track_.mean(interval.begin, interval.begin + monitor_interval)
                      .value_or(Celsius{missing})
                      .value;
  row.board_c = interval.board_c();
  for (std::size_t axis = 0; axis < 3; ++axis)
    row.gyro_mean_lsb[axis] = interval.gyro_mean_lsb(axis);
  row.frames = interval.frames;
  row.frames_missing = interval.frames_missing;
  return journal_.monitor(row);
}

}  // namespace gyrocal::runner
