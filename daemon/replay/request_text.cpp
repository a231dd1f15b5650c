#include "daemon/replay/request_text.h"

#include <fmt/core.h>

#include "drivers/chamber/register_value.h"

namespace gyrocal::replay {

std::string request_text(const ChamberProfile& profile, std::span<const std::uint8_t> request) {
  const auto decoded = modbus::decode_request(request);
  if (!decoded) return {};
  const RegisterSpec& setpoint = profile.temperature_setpoint;
  const bool sets = modbus::is_write(*decoded) && decoded->address == setpoint.address &&
                    decoded->values.size() == word_count(setpoint.type);
  if (!sets) return modbus::to_text(*decoded);
  const auto value = decode_value(setpoint, decoded->values);
  return value ? fmt::format("setpoint {} degC", static_cast<float>(*value))
               : modbus::to_text(*decoded);
}

}  // namespace gyrocal::replay
