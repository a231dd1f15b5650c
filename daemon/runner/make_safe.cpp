#include "daemon/runner/make_safe.h"

#include "daemon/campaign/plan.h"

namespace gyrocal::runner {
namespace {

Result<void> try_once(Celsius safe, Chamber& chamber) {
  const auto reading = chamber.read();
  if (!reading) return tl::unexpected(reading.error());
  if (reading->constant_mode == false) {
    return fail(Errc::busy, "chamber: a program of its own is running; nothing was written",
                "somebody started it at the panel; look after the chamber yourself");
  }
  return chamber.set_setpoint(safe);
}

}  // namespace

Result<void> make_chamber_safe(const CampaignConfig& config, Chamber& chamber, Clock& clock,
                               Duration within) {
  const auto safe = campaign::commandable(allowed_setpoints(config), config.plan.safe_setpoint);
  if (!safe) return tl::unexpected(safe.error());
  const Instant deadline = clock.now() + within;
  for (;;) {
    auto done = try_once(*safe, chamber);
    if (done || done.error().code == Errc::busy) return done;
    if (clock.now() >= deadline) return done;
    clock.sleep_until(clock.now() + within / 25);
  }
}

}  // namespace gyrocal::runner
