#pragma once

#include <cstdint>
#include <vector>

#include "drivers/board/board.h"
#include "drivers/board/frame.h"
#include "drivers/clock.h"

namespace gyrocal::inemo {

/// A data frame that has its place in the stream.
struct DataEvent {
  DataFrame frame;
  std::uint32_t counter = 0;  ///< unwrapped, since Start; after a restart it goes on by one
  bool restarted = false;     ///< the board's counter began anew: how much is missing is unknown
  Instant arrived{};
  bool operator==(const DataEvent&) const = default;
};

/// Unwraps the 16-bit frame counter and finds out frames that are doubled, missing or false.
///
/// A frame that follows the last one passes at once, a repeated number is dropped. A gap of up to
/// 2000 frames passes once the next frame lies ahead of it; any other number must be followed by
/// two in sequence (the board was restarted). Until then such frames wait; those that what follows
/// belies are dropped and counted as rejected. Pure.
class FrameCounter {
 public:
  /// The next frame is number 1, as after Start.
  void reset();
  /// Whether the frame of this number can be passed at once with advance(): the usual case.
  [[nodiscard]] bool is_next(std::uint16_t number) const {
    return held_.empty() && number == static_cast<std::uint16_t>(last_ + 1);
  }
  /// Goes on to the next number, also for a frame that came with impossible values.
  /// @return its unwrapped number.
  std::uint32_t advance() {
    ++last_;
    return ++unwrapped_;
  }
  /// Any other frame; appends to `passed` what is certain now.
  void take(DataEvent event, BoardTally& tally, std::vector<DataEvent>& passed);

 private:
  void pass_gap(DataEvent event, BoardTally& tally, std::vector<DataEvent>& passed);
  void pass_restart(std::vector<DataEvent>& passed, BoardTally& tally);
  bool confirms_held(const DataEvent& event, BoardTally& tally, std::vector<DataEvent>& passed);
  void reject_held(BoardTally& tally);

  std::uint16_t last_ = 0;
  std::uint32_t unwrapped_ = 0;
  std::vector<DataEvent> held_;  ///< at most two: one after a gap, or the first of a restart
};

}  // namespace gyrocal::inemo
