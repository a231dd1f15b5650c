#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/recording/recording_file.h"
#include "schema/store.h"

namespace gyrocal::replay {

/// Where a recorded run lies in its campaign.
struct RecordedSpan {
  RecordedRun run;
  CampaignId campaign{};
  Instant origin{};  ///< the run's clock at campaign time 0
  Duration from{};   ///< campaign time
  Duration to{};     ///< of its last byte
};

/// "CAMPAIGN T_NS", what the recording says a run began at.
struct Begun {
  std::int64_t campaign = 0;
  Duration t{};
};
/// @return bad_frame.
[[nodiscard]] Result<Begun> begun_from(const std::string& text);

/// The runs of a recording that got beyond preflight, in order.
[[nodiscard]] Result<std::vector<RecordedSpan>> recorded_spans(const std::string& recording);

}  // namespace gyrocal::replay
