#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/campaign.h"
#include "daemon/campaign/plan.h"
#include "drivers/board/board.h"
#include "drivers/chamber/chamber.h"
#include "drivers/clock.h"
#include "schema/store.h"

namespace gyrocal::runner {

/// What a campaign acts on. Boards in the order of the campaign file; all outlive the run.
struct Devices {
  Clock& clock;
  Chamber& chamber;
  std::vector<Board*> boards;
};

/// What stands at the other ends of the links.
struct Found {
  ChamberReading chamber;
  std::vector<BoardIdentity> boards;
  std::vector<std::optional<Error>> away;  ///< why a board is, of a campaign that is gone on with
};

/// Reads the chamber: it answers, its reading is one a chamber can have, and no program of its own
/// runs. Writes nothing to it.
[[nodiscard]] Result<ChamberReading> inspect_chamber(const CampaignConfig& config,
                                                     Chamber& chamber);

/// Opens one board, starts it and waits for its first frame; the board then streams.
/// @param patience  how long the first frame may take.
/// @return what the board says of itself; mismatch if the campaign file names another MCU id,
///   timeout if it never streams.
[[nodiscard]] Result<BoardIdentity> inspect_board(const BoardConfig& config, Board& board,
                                                  const BoardMode& mode, Clock& clock,
                                                  Duration patience);

/// Both, for every device; two boards with the same MCU id are the same board: mismatch.
/// @param before  the boards of the campaign that is gone on with: one that does not answer counts
///   as away, as it would if it had gone in the middle. A new campaign begins with all.
[[nodiscard]] Result<Found> preflight(const CampaignConfig& config, Devices& devices,
                                      Duration patience,
                                      std::span<const std::pair<BoardId, BoardRow>> before);

}  // namespace gyrocal::runner
