#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compensation/values/error.h"

namespace gyrocal {

using Bytes = std::vector<std::uint8_t>;

/// Question and answer: one Modbus transaction. This is what is recorded, replayed and broken.
class RequestLink {
 public:
  virtual ~RequestLink() = default;
  /// @param request  unit id, then the PDU (function code and data); no MBAP header, no CRC.
  /// @return unit id and PDU of the reply, exception replies included. timeout, link_lost and
  ///   bad_frame close the link; the next transact() tries to open it again once. Raw libmodbus
  ///   requests all carry transaction id 0, so a late reply would pass for the next one's.
  [[nodiscard]] virtual Result<Bytes> transact(std::span<const std::uint8_t> request) = 0;
};

/// A stream of bytes both ways: a serial port.
class ByteLink {
 public:
  virtual ~ByteLink() = default;
  /// Takes what has arrived, at once; 0 bytes is no error.
  /// @return the number of bytes put into `into`; link_lost once the device is gone.
  [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> into) = 0;
  /// Writes all of `bytes` as one write (the board takes one command a packet).
  [[nodiscard]] virtual Result<void> write(std::span<const std::uint8_t> bytes) = 0;
  /// Opens the device again after link_lost, finding it anew under its stable name.
  [[nodiscard]] virtual Result<void> reopen() = 0;
};

}  // namespace gyrocal
