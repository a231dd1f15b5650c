#include "daemon/notify/watcher.h"

#include <fmt/core.h>

#include <algorithm>

#include "daemon/campaign/campaign.h"
#include "daemon/runner/progress.h"
#include "daemon/status/status_json.h"

namespace gyrocal::notify {
namespace {

using runner::clock_text;
using status::View;

/// The campaign's loop turns many times a second.
constexpr double silent_s = 60;

/// What is away, as a sentence; empty: nothing is.
std::string what_is_away(const View& view) {
  const runner::Snapshot& now = *view.now;
  if (status::chamber_is_stale(view.facts, now)) return "the chamber does not answer";
  for (const auto& board : now.each_board) {
    if (!board.present) return fmt::format("board {} is away ({})", board.name, board.trouble);
  }
  return now.state == "holding" ? now.why : std::string{};
}

}  // namespace

std::vector<Notice> Watcher::look(const View& view, double machine_s) {
  std::vector<Notice> notices;
  if (!view.now || ended_) return notices;
  for (auto notice : {ending(view), outage(view, machine_s), failing(view), delay(view, machine_s),
                      silence(view)}) {
    if (notice) notices.push_back(std::move(*notice));
  }
  return notices;
}

std::optional<Notice> Watcher::ending(const View& view) {
  if (!campaign::has_ended(view.now->state)) return std::nullopt;
  ended_ = true;
  return Notice{view.now->state == "safe" ? "trip" : "ended", view.concern.severity,
                view.concern.sentence, view.concern.advice};
}

std::optional<Notice> Watcher::outage(const View& view, double machine_s) {
  if (ended_) return std::nullopt;
  const std::string away = what_is_away(view);
  if (away.empty()) {
    away_since_s_.reset();
    if (!std::exchange(outage_told_, false)) return std::nullopt;
    return Notice{"outage_over", "info", "Every device answers again.", ""};
  }
  if (!away_since_s_) away_since_s_ = machine_s;
  if (outage_told_ || machine_s - *away_since_s_ < outage_s_) return std::nullopt;
  outage_told_ = true;
  return Notice{"outage", "warning",
                fmt::format("For {:.0f} min: {}.", (machine_s - *away_since_s_) / 60, away),
                view.concern.advice};
}

/// Told again when there are twice as many.
std::optional<Notice> Watcher::failing(const View& view) {
  const status::GivenUp gone = status::given_up(view);
  if (ended_ || !gone.concern || gone.setpoints < 2 * given_up_told_) return std::nullopt;
  given_up_told_ = gone.setpoints;
  return Notice{"failing", gone.concern->severity, gone.concern->sentence, gone.concern->advice};
}

std::optional<Notice> Watcher::delay(const View& view, double machine_s) {
  if (ended_) return std::nullopt;
  const auto end_s = [&](Duration left) {
    return machine_s - view.silent_s + to_seconds(left) / view.facts.time_scale;
  };
  if (!promised_end_s_) promised_end_s_ = end_s(view.now->left_max);
  const double late_s = end_s(view.now->left) - *promised_end_s_;
  if (late_s < behind_s_) return std::nullopt;
  promised_end_s_ = std::max(*promised_end_s_, end_s(view.now->left_max));
  return Notice{"behind", "warning",
                fmt::format("The campaign ends {} later than it promised, {} now.",
                            clock_text(seconds(late_s)),
                            status::utc_text(status::utc_of(view, view.now->t + view.now->left))),
                view.concern.advice};
}

std::optional<Notice> Watcher::silence(const View& view) {
  const bool silent = !ended_ && view.silent_s > silent_s;
  if (!silent || silent_) {
    silent_ = silent;
    return std::nullopt;
  }
  silent_ = true;
  return Notice{"silent", "error", view.concern.sentence, view.concern.advice};
}

}  // namespace gyrocal::notify
