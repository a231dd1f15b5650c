#include "daemon/replay/decision_check.h"

#include <fmt/core.h>

#include "daemon/runner/progress.h"

namespace gyrocal::replay {
namespace {

using runner::clock_text;

constexpr Duration same_moment = std::chrono::seconds{1};

bool same(const EventInsert& a, const EventInsert& b) {
  return a.t_ns == b.t_ns && a.utc_ns == b.utc_ns && a.severity == b.severity && a.kind == b.kind &&
         a.text == b.text;
}

std::string text_of(const EventInsert& event) { return event.kind + ": " + event.text; }

std::string at(const EventInsert& event) { return clock_text(Duration{event.t_ns}); }

Difference decision(Duration t, std::string expected, std::string got, std::string sentence) {
  return {0, t, "decision", std::move(expected), std::move(got), std::move(sentence)};
}

}  // namespace

void DecisionCheck::begin(Instant origin, std::vector<EventInsert> recorded) {
  origin_ = origin;
  recorded_ = std::move(recorded);
}

const EventInsert* DecisionCheck::next_recorded() const {
  return alike_ < recorded_.size() ? &recorded_[alike_] : nullptr;
}

void DecisionCheck::decided(const EventInsert& event) {
  if (decision_ || late_ || more_) return;
  if (tape_.over()) {
    late_ = event;
    return;
  }
  const EventInsert* const recorded = next_recorded();
  if (recorded == nullptr) {
    more_ = event;
  } else if (same(*recorded, event)) {
    ++alike_;
  } else {
    decision_ = decision(
        Duration{event.t_ns}, text_of(*recorded), text_of(event),
        fmt::format("at {} the replay decides \"{}\"; the recorded campaign decided, at {}, \"{}\"",
                    at(event), text_of(event), at(*recorded), text_of(*recorded)));
  }
}

Difference DecisionCheck::at_links() const {
  const Divergence& there = *tape_.diverged();
  const Duration t = there.at - origin_;
  const EventInsert* const next = next_recorded();
  const std::string then =
      next ? fmt::format("\"{}\" at {}", text_of(*next), at(*next)) : "nothing more";
  if (late_ && there.replayed == Tape::asking_utc) {
    return decision(t, then, text_of(*late_),
                    fmt::format("at {} the replay decides \"{}\", where the recorded campaign went "
                                "on ({}); what it decided next was {}",
                                clock_text(t), text_of(*late_), there.recorded, then));
  }
  const bool was_decided = there.recorded == Tape::asking_utc && next &&
                           std::chrono::abs(Duration{next->t_ns} - t) <= same_moment;
  if (was_decided) {
    return decision(t, then, there.replayed,
                    fmt::format("at {} the recorded campaign decided \"{}\"; the replay does not, "
                                "it goes on ({})",
                                clock_text(t), text_of(*next), there.replayed));
  }
  return {0,
          t,
          "command",
          there.recorded,
          there.replayed,
          fmt::format("at {} the recorded campaign did: {}; the replay does: {}", clock_text(t),
                      there.recorded, there.replayed)};
}

std::optional<Difference> DecisionCheck::first(bool cut_off) const {
  if (decision_) return decision_;
  if (tape_.diverged()) return at_links();
  if (cut_off) return std::nullopt;
  if (more_) {
    return decision(Duration{more_->t_ns}, "nothing more", text_of(*more_),
                    fmt::format("at {} the replay decides \"{}\"; the recorded campaign's journal "
                                "has nothing more",
                                at(*more_), text_of(*more_)));
  }
  const Duration end = tape_.reached() - origin_ + end_slack;
  const EventInsert* const next = next_recorded();
  if (next && Duration{next->t_ns} <= end) {
    return decision(Duration{next->t_ns}, text_of(*next), "nothing more",
                    fmt::format("at {} the recorded campaign decided \"{}\"; the replay has ended "
                                "without it",
                                at(*next), text_of(*next)));
  }
  return std::nullopt;
}

}  // namespace gyrocal::replay
