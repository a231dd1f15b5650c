#pragma once

#include <optional>
#include <string>

#include "daemon/replay/replay.h"
#include "daemon/replay/replay_devices.h"
#include "schema/sqlite.h"

namespace gyrocal::replay {

/// What a recorded run is replayed with.
struct RunMaterial {
  std::string recording;
  RecordedRun run;
  CampaignConfig config;
  runner::Circumstances begun;
  std::string against;  ///< the database to compare with
  std::optional<std::int64_t>
      next;              ///< of the next run of its campaign: what that one found stored
  std::string database;  ///< to be written
};

struct RunResult {
  ReplayedRun run;
  std::optional<Difference> difference;
  bool operator==(const RunResult&) const = default;
};

/// Reads what belongs to a run. `campaign` is a file to decide by instead of the recorded one.
[[nodiscard]] Result<RunMaterial> material_of(const std::string& recording, const RecordedRun& run,
                                              const std::optional<std::string>& campaign);

/// Replays one run into `material.database`, which must not exist, and compares.
[[nodiscard]] Result<RunResult> replay_run(const RunMaterial& material);

}  // namespace gyrocal::replay
