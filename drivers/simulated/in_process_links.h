#pragma once

#include <cstdint>
#include <span>

#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/simulated/simulated_board.h"
#include "drivers/simulated/simulated_chamber.h"

namespace gyrocal {

/// The host's end of a simulated board without a wire: what a serial port would be, at whatever
/// speed the clock runs. The clock must be the one all devices of the rig are asked with.
class InProcessBoardLink final : public ByteLink {
 public:
  InProcessBoardLink(SimulatedBoard& board, Clock& clock);
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes) override;
  /// Closes and opens the port: the board notices, and a stale frame may come first.
  [[nodiscard]] Result<void> reopen() override;

 private:
  [[nodiscard]] Result<void> still_there();
  SimulatedBoard& board_;
  Clock& clock_;
  std::uint32_t appearance_;  // the one this link has open
};

/// Modbus without a wire. Silence takes `reply_timeout` of the clock; half a reply and one that is
/// later are silence too, and of a doubled one the second is thrown away unseen, as ModbusLink
/// does.
class InProcessChamberLink final : public RequestLink {
 public:
  InProcessChamberLink(SimulatedChamber& chamber, Clock& clock, Duration reply_timeout)
      : chamber_(chamber), clock_(clock), reply_timeout_(reply_timeout) {}
  [[nodiscard]] Result<Bytes> transact(std::span<const std::uint8_t> request) override;

 private:
  SimulatedChamber& chamber_;
  Clock& clock_;
  Duration reply_timeout_;
};

}  // namespace gyrocal
