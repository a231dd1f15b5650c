#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/link.h"

/// The wire format of the STEVAL-MKI062V2 (iNEMO V2), firmware 2.2, both ways. Pure.
///
/// A frame is `[control][length][id][payload]`, length = 1 + payload bytes, numbers MSB first.
/// There is no sync word and no checksum. Known from ST's firmware source and from UM1744.
namespace gyrocal::inemo {

/// The control bytes seen on the wire. Bits 7:6 tell the kind, bits 1:0 the priority.
enum class Control : std::uint8_t {
  command = 0x20,
  data = 0x40,
  trace = 0x41,
  ack = 0x80,
  nack = 0xC0
};

/// A reply carries the id of its command; only bits 7:6 of its control byte tell them apart.
enum class Id : std::uint8_t {
  connect = 0x00,
  disconnect = 0x01,
  reset = 0x02,
  enter_dfu = 0x03,  ///< never sent: it leaves a board without firmware
  trace = 0x07,
  led = 0x08,
  device_mode = 0x10,
  mcu_id = 0x12,
  firmware_version = 0x13,
  hardware_version = 0x14,
  identify = 0x15,
  ahrs_version = 0x17,
  libraries = 0x18,
  set_sensor_parameter = 0x20,
  get_sensor_parameter = 0x21,
  restore_sensor_parameter = 0x22,
  set_output_mode = 0x50,
  get_output_mode = 0x51,
  start = 0x52,  ///< also the id of every data frame
  stop = 0x53,
};
[[nodiscard]] bool is_known_id(std::uint8_t id);
[[nodiscard]] std::string name_of(Id id);  ///< "Get output mode (51)"

enum class Nack : std::uint8_t {
  forbidden = 0,
  unsupported = 1,
  out_of_range = 2,
  not_executable = 3,
  wrong_syntax = 4,
  not_connected = 5,
};
[[nodiscard]] std::string name_of_nack(std::uint8_t code);  ///< "02 value out of range"

inline constexpr std::size_t header_bytes = 3;
inline constexpr std::uint8_t ack_length_max = 29;  ///< longest reply of firmware 2.2 is shorter
inline constexpr std::uint8_t trace_length_max = 62;

[[nodiscard]] Bytes encode_command(Id id, std::span<const std::uint8_t> payload = {});
[[nodiscard]] Bytes encode_ack(Id id, std::span<const std::uint8_t> payload = {});
[[nodiscard]] Bytes encode_nack(std::uint8_t id, Nack code);

struct FrameView {
  std::uint8_t control;
  std::uint8_t id;
  std::span<const std::uint8_t> payload;
};
/// The frame that fills `bytes` exactly; nothing if the length byte says otherwise. Control byte
/// and id are not judged.
[[nodiscard]] std::optional<FrameView> parse_frame(std::span<const std::uint8_t> bytes);

/// The four bytes of commands 50 and 51: what is streamed and how fast.
struct OutputMode {
  bool ahrs = false;  ///< on a V2 this forces 50 Hz
  bool raw = false;   ///< raw counts; calibrated temperature is broken below 0 degC
  bool accelerometer = false;
  bool gyro = false;
  bool magnetometer = false;
  bool pressure = false;
  bool temperature = false;
  std::uint8_t rate_code = 3;      ///< see rate_hz()
  std::uint16_t sample_count = 0;  ///< 0: endless
  bool operator==(const OutputMode&) const = default;
};
/// After power-up: all sensors, calibrated, 50 Hz, endless.
inline constexpr OutputMode boot_mode{false, false, true, true, true, true, true, 3, 0};

/// Codes 0..6 are 1, 10, 25, 50, 30, 100, 400 Hz; nothing for other codes.
[[nodiscard]] std::optional<int> rate_hz(std::uint8_t code);
[[nodiscard]] std::optional<std::uint8_t> rate_code(int hz);

[[nodiscard]] std::array<std::uint8_t, 4> encode_output_mode(const OutputMode& mode);
/// Nothing if it is not four bytes or has bits set that firmware 2.2 wants zero (7:6 and 2:0 of the
/// second byte).
[[nodiscard]] std::optional<OutputMode> decode_output_mode(std::span<const std::uint8_t> payload);

/// What one data frame carries; sensors that the mode leaves out stay zero.
struct DataFrame {
  std::uint16_t counter = 0;  ///< first frame after Start is 1; wraps 65535 -> 0
  std::array<std::int16_t, 3> accelerometer{};
  std::array<std::int16_t, 3> gyro{};  ///< raw: ADC counts, X roll, Y pitch, Z yaw
  std::array<std::int16_t, 3> magnetometer{};
  std::uint16_t pressure = 0;
  std::int16_t temperature = 0;  ///< raw: degC * 256
  std::array<float, 7> ahrs{};   ///< roll, pitch, yaw [deg], q0..q3
  bool operator==(const DataFrame&) const = default;
};

/// Where each field of a data frame lies, in bytes from the control byte; 0 if absent. V2 sends
/// the pressure as two bytes (an M1 sends four: its frames have another length and are refused).
struct DataLayout {
  std::uint8_t frame_bytes = 0;
  std::uint8_t length = 0;  ///< the frame's length byte
  std::uint8_t accelerometer_at = 0;
  std::uint8_t gyro_at = 0;
  std::uint8_t magnetometer_at = 0;
  std::uint8_t pressure_at = 0;
  std::uint8_t temperature_at = 0;
  std::uint8_t ahrs_at = 0;
  bool operator==(const DataLayout&) const = default;
};
[[nodiscard]] DataLayout layout_of(const OutputMode& mode);

/// Appends the frame to `into`.
void encode_data_frame(const DataLayout& layout, const DataFrame& frame, Bytes& into);
/// @param bytes  at least layout.frame_bytes, whose header has been checked.
[[nodiscard]] DataFrame decode_data_frame(const DataLayout& layout,
                                          std::span<const std::uint8_t> bytes);

}  // namespace gyrocal::inemo
