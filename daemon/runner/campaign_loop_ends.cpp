#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "daemon/runner/campaign_loop.h"

namespace gyrocal::runner {
namespace {

constexpr Kelvin warm_enough{2};
/// A chamber that cannot be told for so long needs a person at its panel.
constexpr Duration safety_tried_for = std::chrono::hours{12};

bool has_visited_all(const campaign::State& state) {
  const auto* returning = std::get_if<campaign::Returning>(&state);
  return (returning && !returning->aborting) ||
         std::holds_alternative<campaign::Analysing>(state) ||
         std::holds_alternative<campaign::Finished>(state);
}

std::string why(const campaign::State& state) {
  if (const auto* safe = std::get_if<campaign::Safe>(&state)) return safe->why;
  if (const auto* holding = std::get_if<campaign::Holding>(&state)) return holding->why;
  return {};
}

}  // namespace

Result<void> CampaignLoop::turn_safing() {
  const Instant began = devices_.clock.now();
  auto done = read_boards();
  if (done) done = read_chamber();
  if (done) done = drive_chamber();
  if (done) done = write_slow_stream();
  if (!done) return done;
  while (hooks_.next_command && hooks_.next_command()) continue;  // refused: nothing follows a trip
  if (hooks_.progress) hooks_.progress(snapshot());
  devices_.clock.sleep_until(began + options_.tick);
  return {};
}

Result<void> CampaignLoop::reach_safety() {
  if (!chamber_.safe_asked()) return {};  // hands off
  const Duration began = now();
  const auto stop_asked = [&] { return hooks_.stop_asked && hooks_.stop_asked(); };
  while (!chamber_.is_safe() && now() - began < safety_tried_for && !stop_asked()) {
    if (auto done = turn_safing(); !done) return done;
  }
  if (!chamber_.is_safe()) {
    return journal_.event(now(), "error", "not_safe",
                          "the chamber could not be told to go to its safe setpoint (" +
                              chamber_.trouble() + "); set it at its panel, now");
  }
  auto told = journal_.event(
      now(), "info", "safe_setpoint",
      fmt::format("the chamber has confirmed its safe setpoint {:.1f} degC", plan_.safe.value));
  if (!told) return told;
  const Duration bound = 2 * ramp_duration(plan_, chamber_.latest().actual, plan_.safe) +
                         seconds(plan_.limits.ramp_timeout_extra_s);
  const Duration confirmed = now();
  while (std::abs((chamber_.latest().actual - plan_.safe).value) > warm_enough.value &&
         now() - confirmed < bound && !stop_asked()) {
    if (auto done = turn_safing(); !done) return done;
  }
  return {};
}

Result<void> CampaignLoop::stop() {
  const Duration began = now();
  chamber_.make_safe();
  for (;;) {
    static_cast<void>(chamber_.drive(now()));  // tried until it is confirmed or the time is over
    if (chamber_.is_safe() || now() - began >= options_.stop_within) break;
    devices_.clock.sleep_until(devices_.clock.now() + options_.tick);
  }
  if (collector_.running()) {
    if (auto stored = store_dwell("the campaign was stopped"); !stored) return stored;
  }
  const std::string where = campaign::describe(plan_, state_);
  if (chamber_.is_safe()) {
    return journal_.event(now(), "info", "stopped",
                          fmt::format("stopped while {}; the chamber has confirmed its safe "
                                      "setpoint {:.1f} degC; --resume goes on from here",
                                      where, plan_.safe.value));
  }
  return journal_.event(now(), "error", "stopped",
                        fmt::format("stopped while {}; the chamber has NOT confirmed its safe "
                                    "setpoint {:.1f} degC ({}); look after it",
                                    where, plan_.safe.value, chamber_.trouble()));
}

Duration CampaignLoop::planned_left() const {
  return time_left(plan_, state_, chamber_.latest().actual, now() - entered_);
}

void CampaignLoop::note_pace(const campaign::State& before) {
  const bool stood = std::holds_alternative<campaign::Paused>(before) ||
                     std::holds_alternative<campaign::Holding>(before);
  if (stood) pace_.stood_still(now() - entered_);
  if (const auto* visit = campaign::visit_of(state_)) {
    pace_.heading_for(visit->point, now(),
                      time_left(plan_, state_, chamber_.latest().actual, Duration{}));
  }
}

Snapshot CampaignLoop::snapshot() const {
  Snapshot s;
  s.t = now();
  s.state = campaign::name(state_);
  s.text = campaign::describe(plan_, state_);
  s.why = why(state_);
  s.since = entered_;
  s.setpoints = plan_.setpoints.size();
  s.setpoints_done = has_visited_all(state_) ? s.setpoints : reached_;
  s.air = chamber_.latest().actual;
  s.setpoint = chamber_.latest().setpoint;
  if (collector_.running()) s.dwell_share = collector_.progress();
  const auto waits = static_cast<int>(s.setpoints - s.setpoints_done);
  const bool on_the_way = campaign::visit_of(state_) != nullptr;
  s.left =
      on_the_way ? pace_.left(s.t, planned_left(), s.setpoints - reached_ - 1) : planned_left();
  s.left_max = s.left + waits * seconds(plan_.stability.air_window_s);
  s.chamber_age = chamber_.age(s.t);
  s.boards = static_cast<int>(boards_.size());
  s.boards_present = static_cast<int>(std::count_if(
      boards_.begin(), boards_.end(), [](const BoardSide& b) { return b.port.present(); }));
  for (std::size_t i = 0; i < boards_.size(); ++i) s.each_board.push_back(snapshot_of(i));
  return s;
}

BoardSnapshot CampaignLoop::snapshot_of(std::size_t board) const {
  const BoardSide& side = boards_[board];
  BoardSnapshot b;
  b.name = plan_.boards[board];
  b.present = side.port.present();
  b.given_up = side.presence == campaign::Presence::given_up;
  if (!b.present) b.trouble = side.port.trouble();
  b.frames = side.port.tally().frames;
  b.frames_missing = side.port.tally().missing;
  b.restarts = side.port.tally().restarts;
  b.latest = side.latest;
  b.slope_k_per_h = conditions_.slope_k_per_h(board);
  return b;
}

}  // namespace gyrocal::runner
