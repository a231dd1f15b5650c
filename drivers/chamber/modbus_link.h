#pragma once

#include <memory>
#include <string>
#include <variant>

#include "config/campaign.h"
#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/tty_lock.h"

struct _modbus;  // libmodbus' own name for modbus_t

namespace gyrocal {

/// Modbus TCP or RTU over libmodbus; with the simulated server the only file that includes its
/// header.
///
/// libmodbus takes late replies for the next one's, other units' and other registers' replies for
/// ours, and its own recovery loops for ever. So: one deadline for the whole reply, what has come
/// unasked is thrown away before each request, each reply is held against its request, and any
/// error closes the connection. RTU frames carry no number at all: after an error the line must be
/// silent for a reply's time before the next request.
class ModbusLink final : public RequestLink {
 public:
  using Address = std::variant<TcpAddress, RtuAddress>;

  /// @param reply_timeout  of the wire, in real time: for connecting and for a whole reply.
  /// @param clock          waits out the silence after an error on RTU; must outlive this.
  /// Connects at the first transact().
  ModbusLink(Address address, Duration reply_timeout, Clock& clock);

  /// @return besides RequestLink's errors: bad_input for an address that is no number, busy for a
  ///   serial port another process holds, out_of_range for a unit libmodbus does not know. An
  ///   exception is a reply. One attempt to connect, none to repeat.
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;

 private:
  struct CloseAndFree {
    void operator()(_modbus* context) const noexcept;
  };
  using Context = std::unique_ptr<_modbus, CloseAndFree>;
  [[nodiscard]] Result<void> connect(int unit);
  [[nodiscard]] Result<Context> new_context();
  [[nodiscard]] Result<Bytes> send_and_receive(std::span<const std::uint8_t> request);
  [[nodiscard]] Result<Bytes> checked(std::span<const std::uint8_t> request, Bytes reply) const;
  [[nodiscard]] tl::unexpected<Error> failed(const std::string& doing, int error_number) const;
  void disconnect();

  Address address_;
  std::string name_;  ///< "192.0.2.5:502"
  Duration reply_timeout_;
  Clock& clock_;
  UniqueFd lock_;  ///< RTU only
  Context context_;
  bool line_may_speak_ = false;  ///< RTU: a reply given up may still come
};

}  // namespace gyrocal
