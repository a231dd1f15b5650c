#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "config/chamber_profile.h"

namespace gyrocal::replay {

/// A chamber's request for people: "setpoint 21.0 degC", "read 2 registers at 160"; empty for what
/// is no request.
[[nodiscard]] std::string request_text(const ChamberProfile& profile,
                                       std::span<const std::uint8_t> request);

}  // namespace gyrocal::replay
