#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "drivers/board/board.h"
#include "drivers/board/frame.h"
#include "drivers/board/frame_counter.h"
#include "drivers/clock.h"

namespace gyrocal::inemo {

/// An acknowledgement or a refusal.
struct ReplyEvent {
  bool ack = false;
  std::uint8_t id = 0;
  Bytes payload;  ///< of a refusal: its code, if it carries one
  bool operator==(const ReplyEvent&) const = default;
};
using Event = std::variant<DataEvent, ReplyEvent>;

struct ParserTiming {
  Duration reply_quiet = seconds(0.01);  ///< silence after which a last reply counts as whole
  Duration partial_max = seconds(1.0);   ///< older beginnings of a frame are given up
};

/// Turns the board's bytes into events. Pure: the time comes with the bytes.
///
/// The protocol has no sync word and no checksum, so a frame counts only if its header is one this
/// board can send now (a data frame: the very length of the mode set) *and* what follows it, as far
/// as it has arrived, begins a frame too. At the end of what has arrived a frame waits for the next
/// bytes, for two silent sample periods (data) or timing.reply_quiet (replies). Everything else is
/// skipped byte by byte and counted. Overwritten payload bytes cannot be found out unless they make
/// an impossible value or counter.
///
/// Per corruption of a stream (1 to 10 bytes dropped, up to 20 inserted, a frame doubled) at most
/// 0.3 good frames are lost and 0.001 bad ones pass; of 1 to 4 bytes overwritten, 0.4 and 0.6
/// (tests/drivers/board/corruption_test.cpp). Exactly one frame's length dropped across two frames
/// leaves one false frame that nothing gives away. O(bytes); memory is bounded.
class Parser {
 public:
  explicit Parser(ParserTiming timing = {}) : timing_(timing) {}

  /// Forgets everything, the mode included: data frames of any mode are then stale and dropped, so
  /// that the reply to Stop is found in whatever a board streams that an earlier host left running.
  void reset();
  /// The mode read back from the board. Data is dropped as stale until Start is acknowledged; then
  /// counter and tally begin anew.
  void expect(const OutputMode& mode);
  /// @param bytes  what has arrived, any amount; nothing tells only that time has passed.
  /// @param now    when it was read.
  void feed(std::span<const std::uint8_t> bytes, Instant now, std::vector<Event>& into);

  [[nodiscard]] const BoardTally& tally() const { return tally_; }

 private:
  /// Whether a frame can begin somewhere: no, perhaps (too few bytes to tell), or yes.
  enum class Head { no, perhaps, yes };
  struct Candidate {
    Head head = Head::no;
    std::size_t frame_bytes = 0;
  };
  [[nodiscard]] Candidate candidate_at(std::size_t at) const;
  [[nodiscard]] bool is_data_length(std::uint8_t length) const;
  [[nodiscard]] bool is_quiet(std::uint8_t control, Instant now) const;
  [[nodiscard]] bool is_possible(const DataFrame& frame) const;
  /// Takes every frame that is certain. @return whether the rest begins a frame cut short.
  bool parse(Instant now, std::vector<Event>& into);
  void accept(std::span<const std::uint8_t> frame, Instant arrived, std::vector<Event>& into);
  void accept_data(std::span<const std::uint8_t> frame, Instant arrived, std::vector<Event>& into);
  void accept_reply(std::span<const std::uint8_t> frame, std::vector<Event>& into);
  void skip_byte();
  void compact();

  ParserTiming timing_;
  std::optional<OutputMode> mode_;
  DataLayout layout_;
  Duration data_quiet_{};
  bool streaming_ = false;
  FrameCounter counter_;
  std::vector<DataEvent> passed_;
  BoardTally tally_;

  std::array<std::uint8_t, 4096> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t earlier_end_ = 0;  ///< bytes below this came with an earlier feed
  Instant earlier_arrival_{};    ///< when those came
  Instant last_arrival_{};
};

}  // namespace gyrocal::inemo
