#include "drivers/simulated/board_firmware.h"

#include <optional>
#include <string_view>

namespace gyrocal {
namespace {

using inemo::Id;
using inemo::Nack;

BoardFirmware::Answer acked(Id id, std::span<const std::uint8_t> payload = {},
                            BoardFirmware::Deed deed = BoardFirmware::Deed::none) {
  return {inemo::encode_ack(id, payload), deed};
}

BoardFirmware::Answer nacked(Id id, Nack code) {
  return {inemo::encode_nack(static_cast<std::uint8_t>(id), code), {}};
}

BoardFirmware::Answer acked_text(Id id, std::string_view text) {
  return acked(id, Bytes(text.begin(), text.end()));
}

/// Payload bytes of a command of fixed length; nothing for those that depend on what is set.
std::optional<std::size_t> payload_size(Id id) {
  switch (id) {
    case Id::set_sensor_parameter:
      return {};
    case Id::trace:
    case Id::led:
      return 1;
    case Id::get_sensor_parameter:
    case Id::restore_sensor_parameter:
      return 2;
    case Id::set_output_mode:
      return 4;
    default:
      return 0;
  }
}

bool changes_settings(Id id) {
  return id == Id::set_output_mode || id == Id::set_sensor_parameter ||
         id == Id::restore_sensor_parameter;
}

}  // namespace

BoardFirmware::Answer BoardFirmware::handle(std::span<const std::uint8_t> packet, bool streaming) {
  const auto frame = inemo::parse_frame(packet);
  const auto id = static_cast<Id>(packet.size() >= inemo::header_bytes ? packet[2] : 0);
  if (!frame || frame->control != static_cast<std::uint8_t>(inemo::Control::command)) {
    return nacked(id, Nack::wrong_syntax);
  }
  if (!connected_ && id != Id::connect) return nacked(id, Nack::not_connected);
  if (!inemo::is_known_id(frame->id)) return nacked(id, Nack::unsupported);
  if (const auto size = payload_size(id); size && frame->payload.size() != *size) {
    return nacked(id, Nack::wrong_syntax);
  }
  return carry_out(id, frame->payload, streaming);
}

BoardFirmware::Answer BoardFirmware::carry_out(Id id, std::span<const std::uint8_t> payload,
                                               bool streaming) {
  if (streaming && changes_settings(id)) return nacked(id, Nack::forbidden);
  switch (id) {
    case Id::connect:
    case Id::disconnect:
      connected_ = id == Id::connect;
      return acked(id);
    case Id::reset:
      return acked(id, {}, Deed::reset);
    case Id::enter_dfu:
      return acked(id, {}, Deed::leave_for_dfu);
    case Id::identify:
      return acked(id, {}, Deed::identify);
    case Id::start:
      return acked(id, {}, Deed::start);
    case Id::stop:
      return acked(id, {}, Deed::stop);
    case Id::trace:
      return {};
    case Id::led:
      return payload[0] <= 1 ? acked(id) : nacked(id, Nack::out_of_range);
    case Id::ahrs_version:
      return nacked(id, Nack::unsupported);
    case Id::set_output_mode:
    case Id::set_sensor_parameter:
    case Id::restore_sensor_parameter:
      return change(id, payload);
    case Id::get_sensor_parameter: {
      const auto value = get_parameter(parameters_, payload);
      return value ? acked(id, *value) : nacked(id, value.error());
    }
    default:
      return tell(id);
  }
}

BoardFirmware::Answer BoardFirmware::tell(Id id) const {
  constexpr std::array<std::uint8_t, 1> zero{0};
  switch (id) {
    case Id::mcu_id:
      return acked(id, Bytes(mcu_id_.rbegin(), mcu_id_.rend()));
    case Id::firmware_version:
      return acked_text(id, "iNEMO Firmware_Version_2.2");
    case Id::hardware_version:
      return acked_text(id, "iNEMO V2 Hardware_Version_1");
    case Id::device_mode:  // a sensor, no master
    case Id::libraries:    // none of the optional ones
      return acked(id, zero);
    case Id::get_output_mode:
      return acked(id, inemo::encode_output_mode(mode_));
    default:
      return nacked(id, Nack::unsupported);
  }
}

BoardFirmware::Answer BoardFirmware::change(Id id, std::span<const std::uint8_t> payload) {
  if (id == Id::set_output_mode) return set_mode(payload);
  const auto refused = id == Id::set_sensor_parameter ? set_parameter(parameters_, payload)
                                                      : restore_parameter(parameters_, payload);
  return refused ? nacked(id, *refused) : acked(id);
}

BoardFirmware::Answer BoardFirmware::set_mode(std::span<const std::uint8_t> payload) {
  const auto mode = inemo::decode_output_mode(payload);
  if (!mode || mode->ahrs || !inemo::rate_hz(mode->rate_code)) {
    return nacked(Id::set_output_mode, Nack::out_of_range);
  }
  mode_ = *mode;
  return acked(Id::set_output_mode);
}

}  // namespace gyrocal
