#pragma once

#include <string>

#include "compensation/values/error.h"
#include "config/campaign.h"
#include "drivers/tty_lock.h"

namespace gyrocal::runner {

/// Takes a chamber for this process alone: two masters fight without noticing, for Modbus has no
/// arbitration. The lock is a listening socket in the abstract namespace: it ends with the process,
/// however it ends, leaves no file, and tells who holds it. A serial chamber's own port is locked
/// besides (drivers/tty_lock.h).
/// @return busy, with the holder's process id and name.
[[nodiscard]] Result<UniqueFd> lock_chamber(const ChamberConfig& chamber);

/// "192.0.2.5:502 unit 1": names the chamber in messages and in its lock.
[[nodiscard]] std::string chamber_name(const ChamberConfig& chamber);

}  // namespace gyrocal::runner
