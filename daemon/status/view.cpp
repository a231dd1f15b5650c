#include "daemon/status/view.h"

#include <utility>

namespace gyrocal::status {
namespace {

void keep_latest(std::vector<EventInsert>& events) {
  if (events.size() <= LiveStatus::events_shown) return;
  events.erase(events.begin(),
               events.end() - static_cast<std::ptrdiff_t>(LiveStatus::events_shown));
}

Point point_of(const Facts& facts, const runner::Snapshot& now) {
  Point point;
  point.t_s = to_seconds(now.t);
  const bool known = !chamber_is_stale(facts, now);
  if (known && now.air) point.chamber_c = now.air->value;
  if (known && now.setpoint) point.setpoint_c = now.setpoint->value;
  for (const BoardView& board : boards_of(facts, now)) {
    point.boards.push_back(
        {board.board_c, board.rate_dps[2], board.slope_k_per_h.value_or(missing)});
  }
  return point;
}

}  // namespace

std::vector<BoardView> boards_of(const Facts& facts, const runner::Snapshot& now) {
  std::vector<BoardView> boards;
  for (std::size_t i = 0; i < now.each_board.size(); ++i) {
    const runner::BoardSnapshot& from = now.each_board[i];
    BoardView board;
    board.name = from.name;
    board.present = from.present;
    board.given_up = from.given_up;
    board.trouble = from.trouble;
    if (from.present) board.slope_k_per_h = from.slope_k_per_h;
    board.slope_limit_k_per_h = facts.slope_limit_k_per_h;
    board.frames = from.frames;
    board.frames_missing = from.frames_missing;
    board.restarts = from.restarts;
    const double sent = double(from.frames + from.frames_missing);
    board.lost_share = sent > 0 ? double(from.frames_missing) / sent : 0;
    if (from.present && from.latest && i < facts.boards.size()) {
      board.board_c = from.latest->board_c();
      board.frames_per_s = double(from.latest->frames) / campaign::monitor_interval_s;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        board.rate_dps[axis] =
            facts.boards[i].scale[axis].to_dps(from.latest->gyro_mean_lsb(axis), board.board_c);
      }
    }
    boards.push_back(std::move(board));
  }
  return boards;
}

bool chamber_is_stale(const Facts& facts, const runner::Snapshot& now) {
  return to_seconds(now.chamber_age) > facts.chamber_stale_s / 2;
}

std::int64_t utc_of(const View& view, Duration t) {
  if (!view.now) return view.utc_ns;
  const double machine_s = to_seconds(t - view.now->t) / view.facts.time_scale - view.silent_s;
  return view.utc_ns + seconds(machine_s).count();
}

void LiveStatus::remember(std::vector<EventInsert> events, const std::vector<Point>& history) {
  view_.events_total += events.size();
  events.insert(events.end(), view_.events.begin(), view_.events.end());
  view_.events = std::move(events);
  keep_latest(view_.events);
  const History since = std::exchange(history_, History{});
  for (const Point& point : history) history_.add(point);
  for (const Point& point : since.points()) history_.add(point);
}

void LiveStatus::report(const runner::Snapshot& now, double machine_s) {
  view_.now = now;
  reported_s_ = machine_s;
  history_.add(point_of(view_.facts, now));
}

void LiveStatus::report(const EventInsert& event) {
  view_.events.push_back(event);
  ++view_.events_total;
  keep_latest(view_.events);
}

void LiveStatus::report(const Mailbox::Content& content, double machine_s) {
  for (const EventInsert& event : content.events) report(event);
  if (content.snapshot) report(*content.snapshot, machine_s);
}

const View& LiveStatus::at(std::int64_t utc_ns, double machine_s) {
  if (!first_s_) first_s_ = machine_s;
  view_.utc_ns = utc_ns;
  view_.silent_s = machine_s - reported_s_.value_or(*first_s_);
  view_.history = history_.points();
  view_.concern = concern_of(view_);
  ++view_.version;
  return view_;
}

}  // namespace gyrocal::status
