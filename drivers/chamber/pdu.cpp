#include "drivers/chamber/pdu.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "compensation/values/assert.h"
#include "drivers/big_endian.h"

namespace gyrocal::modbus {
namespace {

constexpr std::uint8_t exception_bit = 0x80;

bool is_read_function(std::uint8_t function) {
  return function == read_holding_registers || function == read_input_registers;
}

Bytes encode_head(const Request& request) {
  Bytes bytes{request.unit, request.function};
  put_u16(bytes, request.address);
  return bytes;
}

tl::unexpected<Error> no_reply_to(const Request& request, std::span<const std::uint8_t> reply,
                                  const std::string& expected) {
  return fail(Errc::bad_frame,
              fmt::format("{}: reply {:02x} is none to it, expected {}", to_text(request),
                          fmt::join(reply, " "), expected),
              "another device on the line, or a late reply to an earlier request");
}

Result<Words> decode_read_reply(const Request& request, std::span<const std::uint8_t> reply) {
  const std::size_t byte_count = std::size_t{2} * request.count;
  if (reply.size() != 3 + byte_count || reply[2] != byte_count) {
    return no_reply_to(request, reply, fmt::format("{} data bytes", byte_count));
  }
  Words words(request.count);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = get_u16(reply, 3 + 2 * i);
  return words;
}

}  // namespace

std::string name_of(Exception code) {
  const auto text = [code] {
    switch (code) {
      case Exception::illegal_function:
        return "illegal function";
      case Exception::illegal_address:
        return "illegal address";
      case Exception::illegal_value:
        return "illegal value";
      case Exception::device_failure:
        return "device failure";
      case Exception::acknowledge:
        return "acknowledge, still working";
      case Exception::busy:
        return "device busy";
      case Exception::negative_acknowledge:
        return "negative acknowledge";
      case Exception::memory_parity:
        return "memory parity error";
      case Exception::gateway_path:
        return "gateway path unavailable";
      case Exception::gateway_target:
        return "gateway target does not answer";
    }
    return "unknown code";
  }();
  return fmt::format("exception {}, {}", static_cast<int>(code), text);
}

bool is_write(const Request& request) { return !is_read_function(request.function); }

std::string to_text(const Request& request) {
  if (is_write(request)) {
    return fmt::format("write {:04x} to register {}", fmt::join(request.values, " "),
                       request.address);
  }
  return fmt::format("read {} register{} at {}", request.count, request.count == 1 ? "" : "s",
                     request.address);
}

Request read_request(std::uint8_t unit, std::uint8_t function, std::uint16_t address,
                     std::uint16_t count) {
  GYROCAL_ASSERT(is_read_function(function) && count >= 1 && count <= read_count_max);
  return {unit, function, address, count, {}};
}

Request write_request(std::uint8_t unit, std::uint8_t function, std::uint16_t address,
                      Words values) {
  GYROCAL_ASSERT(function == write_multiple_registers || function == write_single_register);
  GYROCAL_ASSERT(!values.empty() && values.size() <= write_count_max);
  GYROCAL_ASSERT(function == write_multiple_registers || values.size() == 1);
  const auto count = static_cast<std::uint16_t>(values.size());
  return {unit, function, address, count, std::move(values)};
}

Bytes encode_request(const Request& request) {
  Bytes bytes = encode_head(request);
  if (request.function != write_single_register) put_u16(bytes, request.count);
  if (request.function == write_multiple_registers) {
    bytes.push_back(static_cast<std::uint8_t>(2 * request.count));
  }
  for (const std::uint16_t value : request.values) put_u16(bytes, value);
  return bytes;
}

std::optional<Exception> exception_in(const Request& request, std::span<const std::uint8_t> reply) {
  if (reply.size() != 3 || reply[0] != request.unit) return {};
  if (reply[1] != (request.function | exception_bit)) return {};
  return static_cast<Exception>(reply[2]);
}

Result<Words> decode_reply(const Request& request, std::span<const std::uint8_t> reply) {
  if (const auto exception = exception_in(request, reply)) {
    return fail(Errc::refused, fmt::format("{}: {}", to_text(request), name_of(*exception)),
                "does the chamber profile fit this controller?");
  }
  if (reply.size() < 3 || reply[0] != request.unit || reply[1] != request.function) {
    return no_reply_to(request, reply,
                       fmt::format("unit {} and function {}", request.unit, request.function));
  }
  if (!is_write(request)) return decode_read_reply(request, reply);
  const Bytes echo = encode_write_reply(request);
  if (!std::equal(reply.begin(), reply.end(), echo.begin(), echo.end())) {
    return no_reply_to(request, reply, fmt::format("{:02x}", fmt::join(echo, " ")));
  }
  return Words{};
}

tl::expected<Request, Exception> decode_request(std::span<const std::uint8_t> bytes) {
  const auto refuse = [](Exception code) { return tl::unexpected<Exception>(code); };
  if (bytes.size() < 2) return refuse(Exception::illegal_value);
  Request request{bytes[0], bytes[1], 0, 1, {}};
  const bool single = request.function == write_single_register;
  const bool multiple = request.function == write_multiple_registers;
  if (!is_read_function(request.function) && !single && !multiple) {
    return refuse(Exception::illegal_function);
  }
  if (bytes.size() < 6) return refuse(Exception::illegal_value);
  request.address = get_u16(bytes, 2);
  if (!single) request.count = get_u16(bytes, 4);
  const std::uint16_t count_max = multiple ? write_count_max : read_count_max;
  if (request.count < 1 || request.count > count_max) return refuse(Exception::illegal_value);
  const std::size_t data_at = single ? 4 : multiple ? 7 : 6;
  const std::size_t data_bytes = is_write(request) ? std::size_t{2} * request.count : 0;
  if (bytes.size() != data_at + data_bytes) return refuse(Exception::illegal_value);
  if (multiple && bytes[6] != data_bytes) return refuse(Exception::illegal_value);
  for (std::size_t i = 0; i < data_bytes; i += 2) {
    request.values.push_back(get_u16(bytes, data_at + i));
  }
  return request;
}

Bytes encode_read_reply(const Request& request, std::span<const std::uint16_t> words) {
  GYROCAL_ASSERT(words.size() == request.count && words.size() <= read_count_max);
  Bytes bytes{request.unit, request.function, static_cast<std::uint8_t>(2 * words.size())};
  for (const std::uint16_t word : words) put_u16(bytes, word);
  return bytes;
}

Bytes encode_write_reply(const Request& request) {
  GYROCAL_ASSERT(!request.values.empty());
  Bytes bytes = encode_head(request);
  put_u16(bytes,
          request.function == write_single_register ? request.values.front() : request.count);
  return bytes;
}

Bytes encode_exception(std::uint8_t unit, std::uint8_t function, Exception code) {
  return {unit, static_cast<std::uint8_t>(function | exception_bit),
          static_cast<std::uint8_t>(code)};
}

}  // namespace gyrocal::modbus
