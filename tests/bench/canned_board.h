#pragma once

#include <span>

#include "drivers/board/inemo_board.h"
#include "drivers/clocks.h"
#include "drivers/simulated/in_process_links.h"
#include "drivers/simulated/simulated_rig.h"

namespace gyrocal::bench {

/// A board that was opened and started, and from then on sends given bytes, so many a read: the
/// driver's own cost without a simulation's.
class CannedLink final : public ByteLink {
 public:
  explicit CannedLink(ByteLink& board) : board_(board) {}
  /// What is read from now on: `bytes_a_read`, then nothing, in turns, as a serial port drained
  /// every so often gives it.
  void play(std::span<const std::uint8_t> bytes, std::size_t bytes_a_read);
  [[nodiscard]] bool ended() const { return playing_ && bytes_.empty(); }

  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Result<void> reopen() override { return board_.reopen(); }

 private:
  ByteLink& board_;
  std::span<const std::uint8_t> bytes_;
  std::size_t bytes_a_read_ = 0;
  bool playing_ = false;
  bool gave_ = false;
};

/// Such a board with its clock.
class CannedBoard {
 public:
  explicit CannedBoard(const BoardMode& mode);
  [[nodiscard]] Board& board() { return board_; }
  [[nodiscard]] CannedLink& link() { return link_; }
  [[nodiscard]] VirtualClock& clock() { return clock_; }
  [[nodiscard]] const Result<void>& started() const { return started_; }

 private:
  VirtualClock clock_;
  SimulatedRig rig_;
  InProcessBoardLink simulated_;
  CannedLink link_;
  InemoBoard board_;
  Result<void> started_;
};

/// The bytes of `frames` data frames in this mode, the first with number 1.
[[nodiscard]] Bytes frames_on_wire(const BoardMode& mode, std::size_t frames);

}  // namespace gyrocal::bench
