#include "daemon/runner/after_trip.h"

#include <fmt/core.h>

#include "daemon/runner/begin.h"
#include "daemon/runner/make_safe.h"

namespace gyrocal::runner {

Result<AfterTrip> after_trip(const Store& store, CampaignId campaign) {
  const auto events = store.events(campaign);
  if (!events) return tl::unexpected(events.error());
  AfterTrip left = AfterTrip::unconfirmed;
  for (const EventInsert& event : *events) {
    if (event.kind == "resumed") left = AfterTrip::unconfirmed;  // a person has re-armed it
    if (event.kind == "hands_off") left = AfterTrip::hands_off;
    if (event.kind == "safe_setpoint") left = AfterTrip::nothing;
  }
  return left;
}

Result<void> complete_trip(const CampaignConfig& config, Store& store, CampaignId campaign,
                           Chamber& chamber, Clock& clock, Duration within) {
  const auto left = after_trip(store, campaign);
  if (!left) return tl::unexpected(left.error());
  if (*left != AfterTrip::unconfirmed) return {};
  if (auto done = make_chamber_safe(config, chamber, clock, within); !done) return done;
  const auto open = store.open_campaign();
  if (!open) return tl::unexpected(open.error());
  const Duration last{*open ? (*open)->t_last_ns : 0};
  return store.add_event(
      campaign, {(last + apart_from_before).count(), clock.utc_ns(), "info", "safe_setpoint",
                 fmt::format("the chamber has confirmed its safe setpoint {:.1f} degC to a daemon "
                             "started after the trip",
                             config.plan.safe_setpoint.value)});
}

}  // namespace gyrocal::runner
