#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compensation/rig/chamber_air.h"
#include "compensation/rig/rig_board.h"
#include "drivers/board/frame.h"
#include "drivers/clock.h"
#include "drivers/link.h"
#include "drivers/simulated/accelerometer.h"
#include "drivers/simulated/board_firmware.h"
#include "drivers/simulated/board_wire.h"

namespace gyrocal {

/// One iNEMO V2 board as a byte machine: packets in, bytes out, frames at the instants the rig
/// takes its samples. Pure: time arrives with every call and never goes backwards. What it sends
/// depends on the packets and their times only, not on how often anybody looks, as long as
/// `output_bytes_max` is not reached.
///
/// Streaming: the first frame is due one period after Start. Each frame counts one up, from 1,
/// wrapping 65535 -> 0; Start and Stop reset the counter. While the host takes nothing (port
/// closed, or its buffer full) the firmware waits with one frame built: ticks that pass meanwhile
/// leave no gap in the counter, and that frame is stale when it comes.
class SimulatedBoard {
 public:
  /// `air` must outlive the board. The host's port is open from the start.
  /// @param output_bytes_max  what the host's side buffers before it throttles the board.
  SimulatedBoard(rig::RigBoard physics, Accelerometer accelerometer, BoardWire wire,
                 const rig::ChamberAir& air, const McuId& mcu_id,
                 std::size_t output_bytes_max = std::numeric_limits<std::size_t>::max());

  /// One write of the host. Lost while the board is away.
  void receive(std::span<const std::uint8_t> packet, Instant now);
  /// Makes everything that was due by `now`.
  void advance(Instant now);

  /// Bytes made and not yet taken; what arrived in the host's kernel, in the case of a port.
  [[nodiscard]] std::span<const std::uint8_t> output() const;
  /// The host took the first `count` of them.
  void take(std::size_t count);

  /// The host closes its port (what it had not read is lost) and opens it again.
  void host_closes(Instant now);
  void host_opens(Instant now);

  /// Pulls the USB plug; plugged in again, the board boots.
  void unplug(Instant now);
  void plug_in(Instant now);
  /// The supply dips: a boot without a word.
  void brown_out(Instant now);

  /// On the bus. A command Reset takes it away for a while, Enter DFU for good.
  [[nodiscard]] bool present() const { return present_; }
  /// Counts the times it appeared on the bus: a changed number is a new device to the host.
  [[nodiscard]] std::uint32_t appearance() const { return appearance_; }
  [[nodiscard]] bool streaming() const { return streaming_; }
  /// When something will happen by itself; nothing if only a packet can change anything.
  [[nodiscard]] std::optional<Instant> next_event() const;

  /// The STLM75's trap: read faster than it converts (150 ms), its register stands still.
  void set_temperature_trap(bool on) { temperature_trap_ = on; }

  /// A fault of the board or its wire begins; the same one ends.
  void begin(const RigFault& fault, Instant now);
  void end(const RigFault& fault, Instant now);
  /// Called first whenever time moves: what happens at its own time, happens before.
  void before_each(std::function<void(Instant)> hook) { before_each_ = std::move(hook); }

 private:
  void reach_events(Instant now);
  void stream_until(std::int64_t t_ns);
  [[nodiscard]] std::int64_t batch_end_ns() const;
  void send(const rig::RigSample& sample);
  void build_frame(const rig::RigSample& sample);
  [[nodiscard]] std::int16_t thermometer(const rig::RigSample& sample);
  [[nodiscard]] bool room_for(std::size_t bytes) const;
  void send_held_frame();
  void answer(std::span<const std::uint8_t> packet, Instant now);
  void start(Instant now);
  void stop();
  void boot(Instant now);
  void leave_bus(Instant now);
  void join_bus(Instant now);
  void put(std::span<const std::uint8_t> bytes);

  rig::RigBoard physics_;
  Accelerometer accelerometer_;
  BoardWire wire_;
  const rig::ChamberAir& air_;
  BoardFirmware firmware_;
  std::size_t output_bytes_max_;

  Bytes output_;
  std::size_t output_begin_ = 0;
  bool host_open_ = true;
  bool present_ = true;
  std::uint32_t appearance_ = 1;

  bool streaming_ = false;
  double rate_hz_ = 0;
  std::uint16_t counter_ = 0;
  std::uint32_t frames_left_ = 0;  // of a counted acquisition; 0: endless
  inemo::DataLayout layout_;
  bool waiting_ = false;  // the firmware busy-waits with held_frame_ built
  Bytes held_frame_;
  std::vector<rig::RigSample> samples_;
  inemo::DataFrame frame_;

  bool mute_ = false;
  bool temperature_trap_ = false;
  std::optional<std::int16_t> last_temperature_;  // since Start

  std::optional<Instant> identify_until_;  // commands wait
  Bytes waiting_packet_;                   // the firmware has one receive buffer
  std::optional<Instant> reset_at_;
  std::optional<Instant> return_at_;
  std::function<void(Instant)> before_each_;
};

}  // namespace gyrocal
