#pragma once

#include "config/campaign.h"
#include "drivers/chamber/chamber.h"
#include "drivers/clock.h"
#include "schema/store.h"

namespace gyrocal::runner {

/// What is left to do for a chamber whose campaign has tripped and whose daemon may have died
/// since.
enum class AfterTrip {
  nothing,      ///< it has confirmed its safe setpoint
  hands_off,    ///< somebody else commands it: not written to unless a person asks
  unconfirmed,  ///< it has not been told, or its confirmation is not on record
};
[[nodiscard]] Result<AfterTrip> after_trip(const Store& store, CampaignId campaign);

/// Does it, as of ten seconds after the latest row, as a resumed run would: tries the safe setpoint
/// for `within` where it is unconfirmed, and puts the confirmation on record. @return what
/// make_chamber_safe() and the store return.
[[nodiscard]] Result<void> complete_trip(const CampaignConfig& config, Store& store,
                                         CampaignId campaign, Chamber& chamber, Clock& clock,
                                         Duration within);

}  // namespace gyrocal::runner
