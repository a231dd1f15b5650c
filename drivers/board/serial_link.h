#pragma once

#include <memory>
#include <string>

#include "drivers/link.h"
#include "drivers/tty_lock.h"

struct sp_port;

namespace gyrocal {

/// A serial port over libserialport, 8N1, no flow control (the default, XON/XOFF, would eat bytes
/// 0x11 and 0x13). The only file that includes its header.
///
/// An unplugged board reads as "nothing there" for ever and its open descriptor keeps its number
/// taken, so every read that gives nothing asks whether the device still lives, and a dead one is
/// closed at once. Nothing is ever drained: on CDC-ACM that can hang.
class SerialLink final : public ByteLink {
 public:
  /// @param device  the stable name, /dev/serial/by-id/...; it is resolved anew at each reopen(),
  ///   for a board that comes back has another number. A pseudo-terminal or a link to one will do.
  /// The link is closed until reopen().
  explicit SerialLink(std::string device) : device_(std::move(device)) {}

  /// link_lost if the device is gone.
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  /// link_lost, or timeout if the device takes nothing for a second; either closes the link.
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  /// link_lost (absent, no terminal, no permission) or busy (with the holder).
  [[nodiscard]] Result<void> reopen() override;

 private:
  struct ClosePort {
    void operator()(sp_port* port) const noexcept;
  };
  using Port = std::unique_ptr<sp_port, ClosePort>;
  [[nodiscard]] static Result<Port> open_port(const std::string& name);
  [[nodiscard]] tl::unexpected<Error> lost(Errc code, const std::string& what);

  std::string device_;
  UniqueFd lock_;
  Port port_;
};

}  // namespace gyrocal
