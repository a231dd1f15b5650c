#pragma once

#include <string>

#include "schema/store.h"

namespace gyrocal::runner {

/// A campaign's models in the manner of the paper's Table 2, one table a board: the paper's three
/// methods and the recommended one, RMSE and MAE of each axis [deg/s], with the leave-one-out error
/// beside them. A board without models says so. @return what the store returns.
[[nodiscard]] Result<std::string> model_table(const Store& store, CampaignId campaign);

}  // namespace gyrocal::runner
