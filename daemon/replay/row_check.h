#pragma once

#include <optional>

#include "daemon/replay/run_replay.h"
#include "schema/compare_campaigns.h"

namespace gyrocal::replay {

/// What a run stored, in the recorded campaign's database and in the replay's.
struct RowCheck {
  CampaignWindow recorded;
  CampaignWindow replayed;
  Duration ended{};                  ///< campaign time of the replay's end
  std::optional<std::int64_t> next;  ///< RunMaterial::next
};

/// Compares dwells, samples, slow stream and, of a run that has analysed, models. Counts what is
/// alike in `result`; a difference earlier than the one it holds takes its place.
[[nodiscard]] Result<void> check_rows(const RowCheck& check, RunResult& result);

}  // namespace gyrocal::replay
