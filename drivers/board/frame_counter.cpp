#include "drivers/board/frame_counter.h"

namespace gyrocal::inemo {
namespace {

constexpr std::uint16_t gap_max = 2000;
constexpr std::size_t restart_frames = 3;

/// How far `number` lies ahead of `from` on the 16-bit circle.
std::uint16_t ahead(std::uint16_t from, std::uint16_t number) {
  return static_cast<std::uint16_t>(number - from);
}
bool is_gap(std::uint16_t distance) { return distance >= 2 && distance <= gap_max; }

}  // namespace

void FrameCounter::reset() {
  last_ = 0;
  unwrapped_ = 0;
  held_.clear();
}

void FrameCounter::take(DataEvent event, BoardTally& tally, std::vector<DataEvent>& passed) {
  const std::uint16_t number = event.frame.counter;
  if (!held_.empty()) {
    if (event.frame == held_.back().frame) {
      ++tally.duplicates;
      return;
    }
    if (confirms_held(event, tally, passed)) return;
  }
  const std::uint16_t distance = ahead(last_, number);
  if (distance == 0) {
    ++tally.duplicates;
  } else if (distance == 1) {
    reject_held(tally);
    event.counter = advance();
    passed.push_back(event);
  } else {
    reject_held(tally);
    held_.push_back(event);
  }
}

bool FrameCounter::confirms_held(const DataEvent& event, BoardTally& tally,
                                 std::vector<DataEvent>& passed) {
  const std::uint16_t from_held = ahead(held_.back().frame.counter, event.frame.counter);
  if (is_gap(ahead(last_, held_.front().frame.counter))) {
    if (from_held >= 1 && from_held <= gap_max) {
      pass_gap(held_.front(), tally, passed);
      held_.clear();
    }
    return false;  // it has no place of its own yet
  }
  if (from_held != 1) return false;
  held_.push_back(event);
  if (held_.size() == restart_frames) pass_restart(passed, tally);
  return true;
}

void FrameCounter::pass_gap(DataEvent event, BoardTally& tally, std::vector<DataEvent>& passed) {
  const std::uint16_t distance = ahead(last_, event.frame.counter);
  tally.missing += distance - 1U;
  last_ = event.frame.counter;
  unwrapped_ += distance;
  event.counter = unwrapped_;
  passed.push_back(event);
}

void FrameCounter::pass_restart(std::vector<DataEvent>& passed, BoardTally& tally) {
  ++tally.restarts;
  held_.front().restarted = true;
  for (DataEvent& event : held_) {
    event.counter = ++unwrapped_;
    last_ = event.frame.counter;
    passed.push_back(event);
  }
  held_.clear();
}

void FrameCounter::reject_held(BoardTally& tally) {
  tally.rejected += held_.size();
  held_.clear();
}

}  // namespace gyrocal::inemo
