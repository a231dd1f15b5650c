#pragma once

#include <cstdint>

#include "drivers/clock.h"
#include "drivers/link.h"

namespace gyrocal {

/// What a chamber's wire does with one request. A sound chamber answers `whole`, or is silent to
/// another unit's request; the rest are faults.
struct ChamberAnswer {
  enum class Way { whole, half, twice, silence, hang_up };
  Way way = Way::silence;
  Bytes reply{};     ///< unit id and PDU
  Duration delay{};  ///< after the request; on real endpoints of real time
};

}  // namespace gyrocal
