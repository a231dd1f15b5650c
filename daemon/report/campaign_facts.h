#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/drift/curve.h"
#include "config/campaign.h"
#include "schema/store.h"

namespace gyrocal::report {

/// A stored model with its curve.
struct ModelFacts {
  ModelInsert row;
  DriftCurve curve;
};

/// One axis of one board.
struct AxisFacts {
  Axis axis = Axis::z;
  std::vector<DwellDriftInsert> drifts;
  std::vector<ModelFacts> models;
  Session session;  ///< monitor and samples in deg/s
};

struct BoardFacts {
  BoardId id{};
  BoardRow board;
  std::vector<AcceptedDwell> accepted;  ///< by setpoint
  std::vector<AxisFacts> axes;          ///< those measured
};

/// All that a campaign's report says, read once.
struct CampaignFacts {
  CampaignRow campaign;
  CampaignConfig config;
  std::vector<BoardFacts> boards;
  std::vector<DwellRow> dwells;  ///< every attempt
  std::vector<EventInsert> events;
  std::optional<AnalysisSettings> analysis;         ///< absent: not analysed
  std::vector<std::vector<std::string>> gap_steps;  ///< of gap_history, as text
};

/// @return bad_input when the database holds no campaign; what Store returns.
[[nodiscard]] Result<CampaignFacts> read_campaign_facts(const std::string& database);

}  // namespace gyrocal::report
