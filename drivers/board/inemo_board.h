#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/board/board.h"
#include "drivers/board/parser.h"
#include "drivers/board/sample_clock.h"
#include "drivers/clock.h"
#include "drivers/link.h"

namespace gyrocal {

/// How long to wait for a board, in campaign time.
struct BoardTiming {
  Duration reply_timeout = seconds(0.5);  ///< for one try; there are three
  Duration partial_frame_max = seconds(1.0);
  Duration reply_quiet = seconds(0.01);  ///< silence that ends a reply

  /// For simulated devices on real wires `scale` times as fast: the wires do not hurry with them.
  [[nodiscard]] static BoardTiming for_time_scale(double scale);
};

/// A STEVAL-MKI062V2 (iNEMO V2) with firmware 2.2. Streams raw counts: calibrated gyro values are
/// whole deg/s, and calibrated temperatures are garbage below 0 degC.
///
/// The board keeps its state when the host dies, so open() takes it over from whatever it is doing.
/// While it streams only Stop is sent: the firmware shares one endpoint between data and replies
/// without a lock.
class InemoBoard final : public Board {
 public:
  /// `link` and `clock` must outlive this. The link is opened by open(). Errors say what went wrong
  /// on the link; which board it is, the caller knows.
  InemoBoard(ByteLink& link, Clock& clock, BoardTiming timing = {});

  [[nodiscard]] Result<BoardIdentity> open(const BoardMode& mode) override;
  [[nodiscard]] Result<void> start() override;
  [[nodiscard]] Result<void> stop() override;
  [[nodiscard]] Result<void> drain(std::vector<BoardSample>& into) override;
  [[nodiscard]] const BoardTally& tally() const override { return tally_; }

 private:
  [[nodiscard]] Result<BoardIdentity> identify();
  [[nodiscard]] Result<void> set_mode(const inemo::OutputMode& mode);
  /// Sends a command and awaits its acknowledgement, up to `tries` times.
  /// @return the payload of the acknowledgement.
  [[nodiscard]] Result<Bytes> command(inemo::Id id, std::span<const std::uint8_t> payload = {},
                                      int tries = 3);
  [[nodiscard]] Result<std::string> read_text(inemo::Id id);
  [[nodiscard]] Result<std::optional<inemo::ReplyEvent>> await_reply(inemo::Id id);
  [[nodiscard]] Result<void> receive();
  void sort_events();
  void stamp(std::size_t first);
  [[nodiscard]] tl::unexpected<Error> link_failed(const Error& error);

  ByteLink& link_;
  Clock& clock_;
  BoardTiming timing_;
  bool link_up_ = false;
  inemo::OutputMode mode_;
  inemo::Parser parser_;
  inemo::SampleClock sample_clock_{1};
  std::vector<inemo::Event> events_;
  std::vector<inemo::ReplyEvent> replies_;
  std::vector<BoardSample> pending_;
  std::int64_t last_t_ns_ = 0;
  std::uint64_t ticks_missed_before_ = 0;  ///< by sample clocks that a restart ended
  BoardTally tally_;
};

}  // namespace gyrocal
