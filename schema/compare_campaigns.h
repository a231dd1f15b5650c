#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "schema/sqlite.h"
#include "schema/store.h"

namespace gyrocal {

/// A campaign in a database, from a time (exclusive) to a time.
struct CampaignWindow {
  const Database& database;
  CampaignId campaign{};
  std::int64_t after_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();
};

/// What of a campaign is compared. Ids and the version of the software are left out, and what later
/// schemas have added to models: those stored before have none of it.
enum class CampaignPart { events, dwells, samples, monitor, drifts, models, model_points };
inline constexpr CampaignPart all_campaign_parts[] = {
    CampaignPart::events, CampaignPart::dwells, CampaignPart::samples,     CampaignPart::monitor,
    CampaignPart::drifts, CampaignPart::models, CampaignPart::model_points};

/// The first row in which two campaigns differ.
struct RowDifference {
  std::int64_t t_ns = 0;  ///< of the row
  std::string row;        ///< "sample: board left, setpoint 2, attempt 1, seq 17"
  std::string column;     ///< the first that differs; empty: one side has no such row
  std::string expected;
  std::string got;
  bool operator==(const RowDifference&) const = default;
};

struct PartComparison {
  std::int64_t rows = 0;  ///< alike, from the first on
  std::optional<RowDifference> difference{};
  /// Rows of one side beyond the end of the other. A crash leaves such; otherwise they differ.
  std::int64_t more_expected = 0;
  std::int64_t more_got = 0;
  /// The first row beyond the end, whichever side has it, as if it differed.
  std::optional<RowDifference> beyond{};
  bool operator==(const PartComparison&) const = default;
};

/// Row by row, in the order they were stored.
/// @param relative  what numbers may differ by; 0: not by a bit.
[[nodiscard]] Result<PartComparison> compare_campaigns(const CampaignWindow& expected,
                                                       const CampaignWindow& got, CampaignPart part,
                                                       double relative = 0);

/// The journal of a campaign in a window, in the order it was written.
[[nodiscard]] Result<std::vector<EventInsert>> events_in(const CampaignWindow& window);

}  // namespace gyrocal
