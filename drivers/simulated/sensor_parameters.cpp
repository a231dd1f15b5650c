#include "drivers/simulated/sensor_parameters.h"

#include <algorithm>
#include <variant>

#include "drivers/big_endian.h"

namespace gyrocal {
namespace {

using ByteMember = std::uint8_t SensorParameters::*;
using OffsetMember = std::int16_t SensorParameters::*;

struct Entry {
  std::uint8_t sensor;
  std::uint8_t parameter;
  std::variant<ByteMember, OffsetMember> member;
  std::array<std::uint8_t, 2> allowed;  // of a byte
};

constexpr std::uint8_t roll_pitch = 2;
constexpr std::uint8_t yaw = 3;
constexpr std::uint8_t pressure = 4;
constexpr std::uint8_t thermometer = 5;

constexpr Entry entries[] = {
    {roll_pitch, 0, &SensorParameters::roll_pitch_full_scale, {4, 8}},
    {roll_pitch, 1, &SensorParameters::roll_offset, {}},
    {roll_pitch, 2, &SensorParameters::pitch_offset, {}},
    {yaw, 0, &SensorParameters::yaw_full_scale, {4, 4}},
    {yaw, 1, &SensorParameters::yaw_offset, {}},
    {pressure, 0, &SensorParameters::pressure_rate, {1, 3}},
    {pressure, 1, &SensorParameters::pressure_offset, {}},
    {thermometer, 0, &SensorParameters::temperature_offset, {}},
};

const Entry* find(std::span<const std::uint8_t> payload) {
  const auto* const found =
      std::find_if(std::begin(entries), std::end(entries), [&](const Entry& entry) {
        return entry.sensor == payload[0] && entry.parameter == payload[1];
      });
  return found == std::end(entries) ? nullptr : found;
}

bool is_gyro_full_scale(const Entry& entry) {
  return entry.parameter == 0 && (entry.sensor == roll_pitch || entry.sensor == yaw);
}

}  // namespace

std::optional<inemo::Nack> set_parameter(SensorParameters& parameters,
                                         std::span<const std::uint8_t> payload) {
  if (payload.size() < 3) return inemo::Nack::wrong_syntax;
  const Entry* const entry = find(payload);
  if (entry == nullptr) return inemo::Nack::out_of_range;
  if (const auto* const offset = std::get_if<OffsetMember>(&entry->member)) {
    if (payload.size() != 4) return inemo::Nack::wrong_syntax;
    parameters.*(*offset) = get_s16(payload, 2);
    return {};
  }
  if (payload.size() != 3) return inemo::Nack::wrong_syntax;
  const auto& allowed = entry->allowed;
  if (std::find(allowed.begin(), allowed.end(), payload[2]) == allowed.end()) {
    return inemo::Nack::out_of_range;
  }
  parameters.*std::get<ByteMember>(entry->member) = payload[2];
  return {};
}

tl::expected<Bytes, inemo::Nack> get_parameter(const SensorParameters& parameters,
                                               std::span<const std::uint8_t> payload) {
  if (payload.size() != 2) return tl::unexpected(inemo::Nack::wrong_syntax);
  const Entry* const entry = find(payload);
  if (entry == nullptr) return tl::unexpected(inemo::Nack::out_of_range);
  Bytes reply{payload[0], payload[1]};
  if (const auto* const offset = std::get_if<OffsetMember>(&entry->member)) {
    put_u16(reply, static_cast<std::uint16_t>(parameters.*(*offset)));
  } else {
    reply.push_back(parameters.*std::get<ByteMember>(entry->member));
  }
  return reply;
}

std::optional<inemo::Nack> restore_parameter(SensorParameters& parameters,
                                             std::span<const std::uint8_t> payload) {
  if (payload.size() != 2) return inemo::Nack::wrong_syntax;
  const Entry* const entry = find(payload);
  if (entry == nullptr) return inemo::Nack::out_of_range;
  if (is_gyro_full_scale(*entry)) return inemo::Nack::not_executable;
  constexpr SensorParameters defaults;
  std::visit([&](auto member) { parameters.*member = defaults.*member; }, entry->member);
  return {};
}

}  // namespace gyrocal
