#include "drivers/board/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "compensation/values/assert.h"
#include "drivers/big_endian.h"

namespace gyrocal::inemo {
namespace {

constexpr std::pair<Id, const char*> names[] = {
    {Id::connect, "Connect"},
    {Id::disconnect, "Disconnect"},
    {Id::reset, "Reset"},
    {Id::enter_dfu, "Enter DFU"},
    {Id::trace, "Trace"},
    {Id::led, "LED"},
    {Id::device_mode, "Device mode"},
    {Id::mcu_id, "MCU id"},
    {Id::firmware_version, "Firmware version"},
    {Id::hardware_version, "Hardware version"},
    {Id::identify, "Identify"},
    {Id::ahrs_version, "AHRS version"},
    {Id::libraries, "Libraries"},
    {Id::set_sensor_parameter, "Set sensor parameter"},
    {Id::get_sensor_parameter, "Get sensor parameter"},
    {Id::restore_sensor_parameter, "Restore sensor parameter"},
    {Id::set_output_mode, "Set output mode"},
    {Id::get_output_mode, "Get output mode"},
    {Id::start, "Start"},
    {Id::stop, "Stop"},
};

constexpr std::array<bool, 256> known_ids = [] {
  std::array<bool, 256> known{};
  for (const auto& [id, name] : names) known[static_cast<std::uint8_t>(id)] = true;
  return known;
}();

constexpr std::array<int, 7> rates_hz{1, 10, 25, 50, 30, 100, 400};

Bytes encode(Control control, std::uint8_t id, std::span<const std::uint8_t> payload) {
  GYROCAL_ASSERT(payload.size() < 0xFF);
  Bytes frame;
  frame.reserve(header_bytes + payload.size());
  frame.push_back(static_cast<std::uint8_t>(control));
  frame.push_back(static_cast<std::uint8_t>(1 + payload.size()));
  frame.push_back(id);
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

void put_axes(Bytes& into, const std::array<std::int16_t, 3>& axes) {
  for (const std::int16_t axis : axes) put_u16(into, static_cast<std::uint16_t>(axis));
}

std::array<std::int16_t, 3> get_axes(std::span<const std::uint8_t> from, std::size_t at) {
  return {get_s16(from, at), get_s16(from, at + 2), get_s16(from, at + 4)};
}

}  // namespace

bool is_known_id(std::uint8_t id) { return known_ids[id]; }

std::string name_of(Id id) {
  const auto* const found = std::find_if(std::begin(names), std::end(names),
                                         [id](const auto& entry) { return entry.first == id; });
  return fmt::format("{} ({:02x})", found == std::end(names) ? "command" : found->second,
                     static_cast<unsigned>(id));
}

std::string name_of_nack(std::uint8_t code) {
  constexpr const char* texts[] = {"forbidden",          "unsupported",  "value out of range",
                                   "not executable now", "wrong syntax", "not connected"};
  return fmt::format("{:02x} {}", code, code < std::size(texts) ? texts[code] : "unknown code");
}

Bytes encode_command(Id id, std::span<const std::uint8_t> payload) {
  return encode(Control::command, static_cast<std::uint8_t>(id), payload);
}

Bytes encode_ack(Id id, std::span<const std::uint8_t> payload) {
  return encode(Control::ack, static_cast<std::uint8_t>(id), payload);
}

Bytes encode_nack(std::uint8_t id, Nack code) {
  const std::array payload{static_cast<std::uint8_t>(code)};
  return encode(Control::nack, id, payload);
}

std::optional<FrameView> parse_frame(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < header_bytes || bytes.size() != std::size_t{bytes[1]} + 2) return {};
  return FrameView{bytes[0], bytes[2], bytes.subspan(header_bytes)};
}

std::optional<int> rate_hz(std::uint8_t code) {
  if (code >= rates_hz.size()) return {};
  return rates_hz[code];
}

std::optional<std::uint8_t> rate_code(int hz) {
  const auto* const found = std::find(rates_hz.begin(), rates_hz.end(), hz);
  if (found == rates_hz.end()) return {};
  return static_cast<std::uint8_t>(found - rates_hz.begin());
}

std::array<std::uint8_t, 4> encode_output_mode(const OutputMode& mode) {
  const int sensors = (mode.ahrs ? 0x80 : 0) | (mode.raw ? 0x20 : 0) |
                      (mode.accelerometer ? 0x10 : 0) | (mode.gyro ? 0x08 : 0) |
                      (mode.magnetometer ? 0x04 : 0) | (mode.pressure ? 0x02 : 0) |
                      (mode.temperature ? 0x01 : 0);
  return {static_cast<std::uint8_t>(sensors), static_cast<std::uint8_t>((mode.rate_code & 7) << 3),
          static_cast<std::uint8_t>(mode.sample_count >> 8),
          static_cast<std::uint8_t>(mode.sample_count & 0xFF)};
}

std::optional<OutputMode> decode_output_mode(std::span<const std::uint8_t> payload) {
  if (payload.size() != 4 || (payload[1] & 0xC7) != 0) return {};
  const auto has = [&](int bit) { return (payload[0] & bit) != 0; };
  OutputMode mode;
  mode.ahrs = has(0x80);
  mode.raw = has(0x20);
  mode.accelerometer = has(0x10);
  mode.gyro = has(0x08);
  mode.magnetometer = has(0x04);
  mode.pressure = has(0x02);
  mode.temperature = has(0x01);
  mode.rate_code = static_cast<std::uint8_t>(payload[1] >> 3);
  mode.sample_count = get_u16(payload, 2);
  return mode;
}

DataLayout layout_of(const OutputMode& mode) {
  DataLayout layout;
  std::uint8_t at = header_bytes + sizeof(std::uint16_t);  // the counter
  const auto place = [&at](bool present, std::uint8_t bytes) {
    const std::uint8_t here = present ? at : std::uint8_t{0};
    if (present) at = static_cast<std::uint8_t>(at + bytes);
    return here;
  };
  layout.accelerometer_at = place(mode.accelerometer, 6);
  layout.gyro_at = place(mode.gyro, 6);
  layout.magnetometer_at = place(mode.magnetometer, 6);
  layout.pressure_at = place(mode.pressure, 2);
  layout.temperature_at = place(mode.temperature, 2);
  layout.ahrs_at = place(mode.ahrs, 28);
  layout.frame_bytes = at;
  layout.length = static_cast<std::uint8_t>(at - 2);
  return layout;
}

void encode_data_frame(const DataLayout& layout, const DataFrame& frame, Bytes& into) {
  into.push_back(static_cast<std::uint8_t>(Control::data));
  into.push_back(layout.length);
  into.push_back(static_cast<std::uint8_t>(Id::start));
  put_u16(into, frame.counter);
  if (layout.accelerometer_at != 0) put_axes(into, frame.accelerometer);
  if (layout.gyro_at != 0) put_axes(into, frame.gyro);
  if (layout.magnetometer_at != 0) put_axes(into, frame.magnetometer);
  if (layout.pressure_at != 0) put_u16(into, frame.pressure);
  if (layout.temperature_at != 0) put_u16(into, static_cast<std::uint16_t>(frame.temperature));
  if (layout.ahrs_at == 0) return;
  for (const float value : frame.ahrs) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    put_u16(into, static_cast<std::uint16_t>(bits >> 16));
    put_u16(into, static_cast<std::uint16_t>(bits & 0xFFFF));
  }
}

DataFrame decode_data_frame(const DataLayout& layout, std::span<const std::uint8_t> bytes) {
  GYROCAL_ASSERT(bytes.size() >= layout.frame_bytes);
  DataFrame frame;
  frame.counter = get_u16(bytes, header_bytes);
  if (layout.accelerometer_at != 0) frame.accelerometer = get_axes(bytes, layout.accelerometer_at);
  if (layout.gyro_at != 0) frame.gyro = get_axes(bytes, layout.gyro_at);
  if (layout.magnetometer_at != 0) frame.magnetometer = get_axes(bytes, layout.magnetometer_at);
  if (layout.pressure_at != 0) frame.pressure = get_u16(bytes, layout.pressure_at);
  if (layout.temperature_at != 0) frame.temperature = get_s16(bytes, layout.temperature_at);
  if (layout.ahrs_at == 0) return frame;
  for (std::size_t i = 0; i < frame.ahrs.size(); ++i) {
    const std::size_t at = layout.ahrs_at + 4 * i;
    const std::uint32_t bits = (std::uint32_t{get_u16(bytes, at)} << 16) | get_u16(bytes, at + 2);
    frame.ahrs[i] = std::bit_cast<float>(bits);
  }
  return frame;
}

}  // namespace gyrocal::inemo
