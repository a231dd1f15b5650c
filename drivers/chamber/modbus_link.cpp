#include "drivers/chamber/modbus_link.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <modbus/modbus.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

#include "drivers/chamber/pdu.h"

namespace gyrocal {
namespace {

constexpr std::size_t tcp_header_bytes = 6;  // before the unit id
constexpr std::size_t rtu_trailer_bytes = 2;

std::string name_of(const ModbusLink::Address& address) {
  if (const auto* tcp = std::get_if<TcpAddress>(&address)) {
    return fmt::format("{}:{}", tcp->host, tcp->port);
  }
  return std::get<RtuAddress>(address).device;
}

/// libmodbus asks no name server: "localhost" would fail with "Success".
bool is_numeric(const std::string& host) {
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1;
}

/// Its header says so: a protocol number of 0.
bool is_modbus_tcp(std::span<const std::uint8_t> adu) { return adu[2] == 0 && adu[3] == 0; }

std::string printable(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += byte >= 32 && byte < 127 ? std::string(1, static_cast<char>(byte))
                                     : fmt::format("\\x{:02x}", byte);
  }
  return text;
}

bool set_timeouts(modbus_t* context, Duration reply_timeout) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(reply_timeout);
  const auto rest = std::chrono::duration_cast<std::chrono::microseconds>(reply_timeout - whole);
  return modbus_set_response_timeout(context, static_cast<std::uint32_t>(whole.count()),
                                     static_cast<std::uint32_t>(rest.count())) == 0 &&
         modbus_set_byte_timeout(context, 0, 0) == 0 &&  // else a dripping peer has no deadline
         modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE) == 0;
}

}  // namespace

void ModbusLink::CloseAndFree::operator()(_modbus* context) const noexcept {
  modbus_close(context);  // free alone leaks the socket
  modbus_free(context);
}

ModbusLink::ModbusLink(Address address, Duration reply_timeout, Clock& clock)
    : address_(std::move(address)),
      name_(name_of(address_)),
      reply_timeout_(reply_timeout),
      clock_(clock) {}

Result<Bytes> ModbusLink::transact(std::span<const std::uint8_t> request) {
  if (!context_) {
    if (const auto connected = connect(request.front()); !connected) {
      disconnect();
      return tl::unexpected(connected.error());
    }
  }
  auto reply = send_and_receive(request);
  // More than one reply: the rest would pass for the next one's.
  if (!reply || modbus_flush(context_.get()) != 0) disconnect();
  return reply;
}

Result<void> ModbusLink::connect(int unit) {
  auto context = new_context();
  if (!context) return tl::unexpected(context.error());
  modbus_t* const modbus = context->get();
  // Without a unit an RTU context aborts the process.
  if (modbus_set_slave(modbus, unit) != 0) {
    return fail(Errc::out_of_range, fmt::format("{}: Modbus unit {}", name_, unit),
                "units are 0 to 247");
  }
  if (!set_timeouts(modbus, reply_timeout_) || modbus_connect(modbus) != 0) {
    return failed("connect", errno);
  }
  if (line_may_speak_) clock_.sleep_until(clock_.now() + reply_timeout_);
  line_may_speak_ = false;
  context_ = std::move(*context);
  return {};
}

Result<ModbusLink::Context> ModbusLink::new_context() {
  if (const auto* tcp = std::get_if<TcpAddress>(&address_)) {
    if (!is_numeric(tcp->host)) {
      return fail(Errc::bad_input, fmt::format("{}: \"{}\" is no IPv4 address", name_, tcp->host),
                  "give the chamber's address in numbers, as 192.0.2.5");
    }
    Context context{modbus_new_tcp(tcp->host.c_str(), tcp->port)};
    if (!context) return failed("prepare", errno);
    return context;
  }
  const auto& rtu = std::get<RtuAddress>(address_);
  auto lock = lock_tty(rtu.device);
  if (!lock) return tl::unexpected(lock.error());
  lock_ = std::move(*lock);
  Context context{modbus_new_rtu(rtu.device.c_str(), rtu.baud, rtu.parity, 8, rtu.stop_bits)};
  if (!context) return failed("prepare", errno);
  return context;
}

Result<Bytes> ModbusLink::send_and_receive(std::span<const std::uint8_t> request) {
  modbus_t* const modbus = context_.get();
  if (modbus_set_slave(modbus, request.front()) != 0) {
    return fail(Errc::out_of_range, fmt::format("{}: Modbus unit {}", name_, request.front()),
                "units are 0 to 247");
  }
  if (modbus_flush(modbus) < 0) return failed("flush", errno);
  const int sent =
      modbus_send_raw_request(modbus, request.data(), static_cast<int>(request.size()));
  if (sent < 0) return failed("send", errno);
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> adu{};
  const int received = modbus_receive_confirmation(modbus, adu.data());
  const int error_number = errno;
  const bool is_tcp = std::holds_alternative<TcpAddress>(address_);
  if (is_tcp && !is_modbus_tcp(adu)) {
    return fail(Errc::bad_frame,
                fmt::format("{}: what answers there is no Modbus TCP: it begins with \"{}\"", name_,
                            printable(std::span(adu).first(tcp_header_bytes + 2))),
                "is that the chamber's Modbus port (502 to 506 on a Yinhe)?");
  }
  if (received < 0) return failed("receive", error_number);
  const std::size_t begin = is_tcp ? tcp_header_bytes : 0;
  const std::size_t trailer = is_tcp ? 0 : rtu_trailer_bytes;
  const auto size = static_cast<std::size_t>(received);
  if (size < begin + trailer + 2) {  // libmodbus drops an RTU frame of another unit: size 0
    return fail(Errc::bad_frame, fmt::format("{}: the reply is another unit's", name_),
                "does each device on the line have its own unit number?");
  }
  return checked(request, Bytes(adu.data() + begin, adu.data() + size - trailer));
}

Result<Bytes> ModbusLink::checked(std::span<const std::uint8_t> request, Bytes reply) const {
  const auto asked = modbus::decode_request(request);
  if (!asked) return reply;
  const auto words = modbus::decode_reply(*asked, reply);
  if (words || words.error().code == Errc::refused) return reply;
  return fail(words.error().code, fmt::format("{}: {}", name_, words.error().what),
              words.error().advice);
}

tl::unexpected<Error> ModbusLink::failed(const std::string& doing, int error_number) const {
  if (error_number == ETIMEDOUT || error_number == EINPROGRESS) {  // the latter from connecting
    return fail(context_ ? Errc::timeout : Errc::link_lost,
                fmt::format("{}: {}: nothing in {} s", name_, doing, to_seconds(reply_timeout_)),
                context_
                    ? "it took the connection: is that the chamber's Modbus port (502 to 506 on "
                      "a Yinhe), its panel in network mode, the unit number right?"
                    : "is the chamber on, its panel in network mode, the address right?");
  }
  return fail(error_number >= MODBUS_ENOBASE ? Errc::bad_frame : Errc::link_lost,
              fmt::format("{}: {}: {}", name_, doing, modbus_strerror(error_number)),
              "check cable, address and port");
}

void ModbusLink::disconnect() {
  line_may_speak_ = line_may_speak_ || (context_ && std::holds_alternative<RtuAddress>(address_));
  context_.reset();
  lock_ = UniqueFd{};
}

}  // namespace gyrocal
