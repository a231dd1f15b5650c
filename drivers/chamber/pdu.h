#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compensation/values/error.h"
#include "drivers/link.h"

/// Modbus requests and replies as RequestLink carries them: unit id, then the PDU; no MBAP header
/// and no CRC. Pure, both ways. Source: MODBUS Application Protocol V1.1b3, sections 6.3, 6.4, 6.6,
/// 6.12 and 7.
namespace gyrocal::modbus {

using Words = std::vector<std::uint16_t>;

enum Function : std::uint8_t {
  read_holding_registers = 3,
  read_input_registers = 4,
  write_single_register = 6,
  write_multiple_registers = 16,
};

enum class Exception : std::uint8_t {
  illegal_function = 1,
  illegal_address = 2,
  illegal_value = 3,
  device_failure = 4,
  acknowledge = 5,
  busy = 6,
  negative_acknowledge = 7,
  memory_parity = 8,
  gateway_path = 10,
  gateway_target = 11,
};
[[nodiscard]] std::string name_of(Exception code);  ///< "exception 2, illegal address"

inline constexpr std::uint16_t read_count_max = 125;
inline constexpr std::uint16_t write_count_max = 123;

/// A request as the server understands it; `values` are empty for a read, `count` counts both.
struct Request {
  std::uint8_t unit = 1;
  std::uint8_t function = read_holding_registers;
  std::uint16_t address = 0;
  std::uint16_t count = 0;
  Words values;
  bool operator==(const Request&) const = default;
};
[[nodiscard]] bool is_write(const Request& request);
[[nodiscard]] std::string to_text(const Request& request);  ///< "read 2 registers at 160"

// The client's side.

/// @param count  1..read_count_max
[[nodiscard]] Request read_request(std::uint8_t unit, std::uint8_t function, std::uint16_t address,
                                   std::uint16_t count);
/// @param values  1..write_count_max words; exactly one for write_single_register.
[[nodiscard]] Request write_request(std::uint8_t unit, std::uint8_t function, std::uint16_t address,
                                    Words values);
[[nodiscard]] Bytes encode_request(const Request& request);
/// The exception a reply carries, if it is a well-formed exception reply to `request`.
[[nodiscard]] std::optional<Exception> exception_in(const Request& request,
                                                    std::span<const std::uint8_t> reply);
/// Checks that `reply` answers `request`: unit, function, and for a read the byte count, for a
/// write the echo of address and value or count.
/// @return the words read (none for a write); refused for an exception, bad_frame for the rest.
[[nodiscard]] Result<Words> decode_reply(const Request& request,
                                         std::span<const std::uint8_t> reply);

// The server's side.

/// @return the request, or the exception a server answers: illegal_function for a function that is
///   none of the four, illegal_value for a count out of range or a length that does not fit.
[[nodiscard]] tl::expected<Request, Exception> decode_request(std::span<const std::uint8_t> bytes);
[[nodiscard]] Bytes encode_read_reply(const Request& request, std::span<const std::uint16_t> words);
[[nodiscard]] Bytes encode_write_reply(const Request& request);
[[nodiscard]] Bytes encode_exception(std::uint8_t unit, std::uint8_t function, Exception code);

}  // namespace gyrocal::modbus
