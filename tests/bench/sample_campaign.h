#pragma once

#include <random>
#include <string>
#include <vector>

#include "config/campaign.h"
#include "schema/store.h"

namespace gyrocal::bench {

/// Campaigns as the daemon leaves them before their analysis: noise of the paper's size on a curved
/// drift. Fixed seeds: the same rows each time.
struct CampaignShape {
  int boards = 1;
  int setpoints = 25;
  int dwell_samples = 3000;
  int monitor_rows = 0;  ///< of each board's slow stream, one in 5 s
  std::string name = "bench";
  [[nodiscard]] std::int64_t samples() const {
    return std::int64_t{boards} * setpoints * dwell_samples;
  }
};

[[nodiscard]] std::vector<BoardSample> dwell_at(double board_c, int samples, std::mt19937& random);
/// The row of such a dwell.
[[nodiscard]] DwellRow dwell_row(BoardId board, int ordinal, std::span<const BoardSample> samples);

/// Writes such a campaign group by group.
[[nodiscard]] Result<CampaignId> write_campaign(Store& store, const CampaignShape& shape);
/// Its beginning: plan and boards, named board0, board1 ...
[[nodiscard]] Result<CampaignId> begin_campaign(Store& store, const CampaignShape& shape,
                                                std::vector<BoardId>& boards);

[[nodiscard]] Result<CampaignConfig> demo_campaign();

}  // namespace gyrocal::bench
