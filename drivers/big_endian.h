#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/link.h"

namespace gyrocal {

/// Both wires of this rig send the most significant byte first.
inline void put_u16(Bytes& into, std::uint16_t value) {
  into.push_back(static_cast<std::uint8_t>(value >> 8));
  into.push_back(static_cast<std::uint8_t>(value & 0xFF));
}
[[nodiscard]] constexpr std::uint16_t get_u16(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::uint16_t>((from[at] << 8) | from[at + 1]);
}
[[nodiscard]] constexpr std::int16_t get_s16(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::int16_t>(get_u16(from, at));
}

}  // namespace gyrocal
