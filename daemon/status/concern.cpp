#include "daemon/status/concern.h"

#include <fmt/core.h>

#include <array>
#include <optional>

#include "daemon/campaign/campaign.h"
#include "daemon/runner/progress.h"
#include "daemon/status/view.h"

namespace gyrocal::status {
namespace {

using runner::clock_text;

/// The loop turns fifty times a second; a board tried again takes it a few seconds.
constexpr double silent_s_max = 30;
/// A warning or an error counts for so long.
constexpr Duration event_counts_for = std::chrono::minutes{15};

std::optional<Concern> silence(const View& view) {
  if (!view.now && view.silent_s <= silent_s_max) {
    return Concern{"info", "The campaign has not begun: chamber and boards are being looked for.",
                   ""};
  }
  if (view.silent_s <= silent_s_max) return std::nullopt;
  if (!view.now) {
    return Concern{"warning", "Chamber and boards are still being looked for.",
                   "Is everything switched on and plugged in? gyrocal check " +
                       view.facts.campaign_path + " says what answers."};
  }
  if (campaign::has_ended(view.now->state)) return std::nullopt;
  return Concern{
      "error",
      fmt::format("The daemon has not reported for {:.0f} s of the machine's time.", view.silent_s),
      "Its watchdog restarts it; if this stays, look at its journal and at the chamber's "
      "panel."};
}

/// What has become of the chamber since the trip, from the events that followed it.
std::string chamber_after_trip(const View& view) {
  for (auto event = view.events.rbegin(); event != view.events.rend(); ++event) {
    if (event->kind == "safe_setpoint") return "The chamber has confirmed its safe setpoint.";
    if (event->kind == "hands_off") return "The chamber is left to whoever else commands it.";
    if (event->kind == "not_safe") break;
  }
  return "The chamber has NOT confirmed its safe setpoint.";
}

std::optional<Concern> ending(const View& view) {
  const runner::Snapshot& now = *view.now;
  if (now.state == "safe") {
    return Concern{
        "error", "The campaign has tripped: " + now.why + ".",
        chamber_after_trip(view) + " Look after it and remove the cause; then 'gyrocal run " +
            view.facts.campaign_path + " --resume' goes on with the first unfinished setpoint."};
  }
  if (now.state == "aborted") {
    return Concern{"warning", "An operator has ended the campaign.", ""};
  }
  if (now.state == "finished") {
    return Concern{"info", "The campaign has finished.",
                   fmt::format("gyrocal report --db {} -o report.html", view.facts.database)};
  }
  return std::nullopt;
}

std::optional<Concern> chamber_trouble(const View& view) {
  const runner::Snapshot& now = *view.now;
  if (chamber_is_stale(view.facts, now)) {
    return Concern{"warning",
                   fmt::format("The chamber has not answered for {}; after {:.0f} s the campaign "
                               "trips.",
                               clock_text(now.chamber_age), view.facts.chamber_stale_s),
                   "Is it switched on, in network mode, its cable plugged in?"};
  }
  return std::nullopt;
}

std::optional<Concern> board_trouble(const View& view) {
  for (const auto& board : view.now->each_board) {
    if (board.present) continue;
    const std::string goes_on =
        board.given_up ? " The campaign goes on without it until it returns." : "";
    return Concern{board.given_up ? "error" : "warning",
                   fmt::format("Board {} is away: {}.{}", board.name, board.trouble, goes_on),
                   "Check its cable and power; it is tried again by itself."};
  }
  return std::nullopt;
}

std::optional<Concern> waiting(const View& view) {
  const runner::Snapshot& now = *view.now;
  const std::string lasts = clock_text(now.t - now.since);
  if (now.state == "holding") {
    return Concern{"warning", fmt::format("The campaign waits since {}: {}.", lasts, now.why),
                   "It goes on by itself when the device is back."};
  }
  if (now.state == "paused") {
    return Concern{"warning", fmt::format("An operator has paused the campaign, {} ago.", lasts),
                   "gyrocal resume " + view.facts.campaign};
  }
  return std::nullopt;
}

std::optional<Concern> setpoints_given_up(const View& view) { return given_up(view).concern; }

std::optional<Concern> long_soak(const View& view) {
  const runner::Snapshot& now = *view.now;
  const std::string lasts = clock_text(now.t - now.since);
  const bool lasts_long =
      now.state == "soaking" && to_seconds(now.t - now.since) > 0.8 * view.facts.soak_s_max;
  if (lasts_long) {
    return Concern{"warning",
                   fmt::format("This soak has lasted {}; after {} the setpoint has failed.", lasts,
                               clock_text(seconds(view.facts.soak_s_max))),
                   "Is the chamber closed? Its cycling may be wider than air_peak_to_peak_k."};
  }
  return std::nullopt;
}

std::optional<Concern> frames_lost(const View& view) {
  for (const BoardView& board : boards_of(view.facts, *view.now)) {
    if (board.lost_share <= view.facts.frames_lost_share_max) continue;
    return Concern{
        "warning",
        fmt::format("Board {} has lost {:.1f} % of its frames; a dwell is rejected "
                    "beyond {:.1f} %.",
                    board.name, 100 * board.lost_share, 100 * view.facts.frames_lost_share_max),
        "Try another cable or USB port, without a hub."};
  }
  return std::nullopt;
}

std::optional<Concern> told_lately(const View& view) {
  for (auto event = view.events.rbegin(); event != view.events.rend(); ++event) {
    if (view.now->t - Duration{event->t_ns} > event_counts_for) break;
    if (event->severity == "info") continue;
    return Concern{
        "warning",
        fmt::format("{} ago: {}.", clock_text(view.now->t - Duration{event->t_ns}), event->text),
        "Nothing to do unless it happens again."};
  }
  return std::nullopt;
}

}  // namespace

GivenUp given_up(const View& view) {
  GivenUp gone;
  const EventInsert* latest = nullptr;
  for (const EventInsert& event : view.events) {
    if (event.kind != "setpoint_failed") continue;
    ++gone.setpoints;
    latest = &event;
  }
  if (!view.now || gone.setpoints < 2) return gone;
  gone.concern = Concern{
      "error",
      fmt::format("{} of {} setpoints have been given up; the latest, {} ago: {}.", gone.setpoints,
                  view.now->setpoints, clock_text(view.now->t - Duration{latest->t_ns}),
                  latest->text),
      fmt::format("The others may go the same way. 'gyrocal abort {}' ends the campaign; mend "
                  "the cause, or the limit in {}, and start again.",
                  view.facts.campaign, view.facts.campaign_path)};
  return gone;
}

Concern concern_of(const View& view) {
  if (auto found = silence(view)) return *found;
  constexpr std::array worst_first{ending,      chamber_trouble,    board_trouble,
                                   waiting,     setpoints_given_up, long_soak,
                                   frames_lost, told_lately};
  for (const auto& look : worst_first) {
    if (auto found = look(view)) return *found;
  }
  return {"info", "Nothing is wrong.", ""};
}

}  // namespace gyrocal::status
