#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/values/units.h"
#include "daemon/runner/back_off.h"
#include "drivers/board/board.h"
#include "drivers/clock.h"

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
  /// It did not answer when the campaign was gone on with: away from now on.
  void missed(Duration t, const std::string& why) { lost(t, why); }
  /// For a board whose temperature register stands still at the sampling rate: breaks the stream
  /// off, reads it at 1 Hz, and streams again without it. Takes a few seconds.
  /// @return nothing if the board did not go along; it is away then.
  [[nodiscard]] std::optional<Celsius> read_temperature(Duration t, Clock& clock);

  [[nodiscard]] bool present() const { return present_; }
  /// Since when it has been away; nothing while it is present.
  [[nodiscard]] std::optional<Duration> away_since() const { return away_since_; }
  /// Why it is away.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  [[nodiscard]] const BoardTally& tally() const { return board_.tally(); }

 private:
  void lost(Duration t, const std::string& why);
  void try_again(Duration t);
  [[nodiscard]] Result<void> stream(const BoardMode& mode);
  [[nodiscard]] Result<Celsius> first_temperature(Clock& clock);

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
