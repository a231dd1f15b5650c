#pragma once

#include <string>
#include <vector>

#include "daemon/report/campaign_facts.h"
#include "daemon/report/figure.h"

namespace gyrocal::report {

/// A figure with the name that asks for it alone, such as "board0_z_drift".
struct NamedFigure {
  std::string name;
  std::string caption;
  Figure figure;
};

/// Chamber and boards over the whole campaign, the accepted dwells shaded: "temperatures".
[[nodiscard]] NamedFigure temperature_figure(const CampaignFacts& facts);

/// One axis: the first dwell raw and filtered (the paper's Fig. 6 and 7), zero drift over
/// temperature with all models and the recommended one's band (its Fig. 8), what they leave, and
/// the Allan deviation over all dwells. Fewer where the campaign has less.
[[nodiscard]] std::vector<NamedFigure> axis_figures(const CampaignFacts& facts,
                                                    const BoardFacts& board, const AxisFacts& axis);

}  // namespace gyrocal::report
