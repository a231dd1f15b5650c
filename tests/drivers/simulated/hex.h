#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <sstream>
#include <string>

#include "drivers/link.h"

namespace gyrocal {

/// "20 01 00" as bytes, and back.
inline Bytes bytes(const std::string& hex) {
  Bytes result;
  std::istringstream words(hex);
  for (unsigned value = 0; words >> std::hex >> value;) {
    result.push_back(static_cast<std::uint8_t>(value));
  }
  return result;
}
inline std::string hex(std::span<const std::uint8_t> of) {
  return fmt::format("{:02x}", fmt::join(of, " "));
}

}  // namespace gyrocal
