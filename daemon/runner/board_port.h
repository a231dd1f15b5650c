#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/runner/back_off.h"
#include "drivers/board/board.h"

namespace gyrocal::runner {

/// One board of a campaign: read, noticed when it goes, opened again with back-off, and checked to
/// be the same one when it returns.
class BoardPort {
 public:
  /// @param board  open and streaming, as `identity`.
  /// @param stale_after  no frame for so long: it is away.
  BoardPort(Board& board, BoardIdentity identity, BoardMode mode, Duration stale_after, Duration t);

  /// Takes what has arrived. While the board is away this is where it is tried again, which can
  /// take seconds.
  void poll(Duration t, std::vector<BoardSample>& into);
  void stop();

  [[nodiscard]] bool present() const { return present_; }
  /// Since when it has been away; nothing while it is present.
  [[nodiscard]] std::optional<Duration> away_since() const { return away_since_; }
  /// Why it is away.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  [[nodiscard]] const BoardTally& tally() const { return board_.tally(); }

 private:
  void lost(Duration t, const std::string& why);
  void try_again(Duration t);

  Board& board_;
  BoardMode mode_;
  Duration stale_after_;
  BackOff back_off_;
  BoardIdentity identity_;
  bool present_ = true;
  std::optional<Duration> away_since_;
  Duration last_frame_{};
  std::string trouble_;
};

}  // namespace gyrocal::runner
