#pragma once

#include <cstdint>
#include <span>

#include "compensation/values/error.h"
#include "config/chamber_profile.h"
#include "drivers/chamber/pdu.h"

namespace gyrocal {

/// Registers a value of this type takes.
[[nodiscard]] std::uint16_t word_count(RegisterType type);

/// The words that stand for `value`, rounded to what the register can hold. float32 is packed here
/// and not by libmodbus: Debian 12's modbus_set_float_abcd(22) emits B041 0000, which a chamber
/// takes for -7e-10 degC.
/// @return not_finite, or out_of_range if the register cannot hold it.
[[nodiscard]] Result<modbus::Words> encode_value(const RegisterSpec& reg, double value);

/// @param words  exactly word_count(reg.type).
/// @return the physical value; not_finite for the bit patterns of NaN and infinity.
[[nodiscard]] Result<double> decode_value(const RegisterSpec& reg,
                                          std::span<const std::uint16_t> words);

}  // namespace gyrocal
