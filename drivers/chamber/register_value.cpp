#include "drivers/chamber/register_value.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

template <class Integer>
Result<modbus::Words> encode_integer(const RegisterSpec& reg, double value) {
  using Limits = std::numeric_limits<Integer>;
  const double raw = std::round(value / reg.scale);
  if (!(raw >= Limits::min() && raw <= Limits::max())) {
    return fail(Errc::out_of_range,
                fmt::format("register {} cannot hold {} (raw {}, from {} to {})", reg.address,
                            value, raw, Limits::min(), Limits::max()),
                "check type and scale in the chamber profile");
  }
  return modbus::Words{static_cast<std::uint16_t>(static_cast<Integer>(raw))};
}

Result<modbus::Words> encode_float32(const RegisterSpec& reg, double value) {
  const auto raw = static_cast<float>(value / reg.scale);
  if (!std::isfinite(raw)) {
    return fail(Errc::out_of_range, fmt::format("register {} cannot hold {}", reg.address, value));
  }
  const auto bits = std::bit_cast<std::uint32_t>(raw);
  modbus::Words words{static_cast<std::uint16_t>(bits >> 16),
                      static_cast<std::uint16_t>(bits & 0xFFFF)};
  if (reg.order == WordOrder::low_word_first) std::swap(words[0], words[1]);
  return words;
}

double decode_float32(WordOrder order, std::uint16_t first, std::uint16_t second) {
  if (order == WordOrder::low_word_first) std::swap(first, second);
  return static_cast<double>(std::bit_cast<float>((std::uint32_t{first} << 16) | second));
}

}  // namespace

std::uint16_t word_count(RegisterType type) { return type == RegisterType::float32 ? 2 : 1; }

Result<modbus::Words> encode_value(const RegisterSpec& reg, double value) {
  if (!std::isfinite(value)) {
    return fail(Errc::not_finite, fmt::format("{} for register {}", value, reg.address));
  }
  switch (reg.type) {
    case RegisterType::int16:
      return encode_integer<std::int16_t>(reg, value);
    case RegisterType::uint16:
      return encode_integer<std::uint16_t>(reg, value);
    case RegisterType::float32:
      break;
  }
  return encode_float32(reg, value);
}

Result<double> decode_value(const RegisterSpec& reg, std::span<const std::uint16_t> words) {
  GYROCAL_ASSERT(words.size() == word_count(reg.type));
  if (reg.type == RegisterType::int16) return static_cast<std::int16_t>(words[0]) * reg.scale;
  if (reg.type == RegisterType::uint16) return words[0] * reg.scale;
  const double value = decode_float32(reg.order, words[0], words[1]) * reg.scale;
  if (!std::isfinite(value)) {
    return fail(Errc::not_finite,
                fmt::format("register {} holds {:04x} {:04x}, which is no number", reg.address,
                            words[0], words[1]),
                "check address, type and word order in the chamber profile");
  }
  return value;
}

}  // namespace gyrocal
