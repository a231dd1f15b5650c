#include <algorithm>

#include "drivers/big_endian.h"
#include "drivers/simulated/simulated_chamber.h"

namespace gyrocal {
namespace {

constexpr std::size_t address_at = 2;

void put_address(Bytes& bytes, std::uint16_t address) {
  bytes[address_at] = static_cast<std::uint8_t>(address >> 8);
  bytes[address_at + 1] = static_cast<std::uint8_t>(address & 0xFF);
}

}  // namespace

ChamberAnswer SimulatedChamber::exchange(std::span<const std::uint8_t> request, Instant now) {
  if (before_each_) before_each_(now);
  using Kind = RigFaultKind;
  using Way = ChamberAnswer::Way;
  if (refuses()) return {Way::hang_up};
  const bool is_ours = request.size() >= 2 && request[0] == unit_;
  if (!is_ours || active(Kind::dead) != nullptr) return {Way::silence};
  if (const auto* const fault = active(Kind::exception)) {
    return {Way::whole, modbus::encode_exception(request[0], request[1],
                                                 static_cast<modbus::Exception>(fault->value))};
  }
  auto reply = active(Kind::wrong_register) != nullptr ? answer_for_another(request, now)
                                                       : answer(request, now);
  if (!reply || active(Kind::lost) != nullptr) return {Way::silence};
  if (active(Kind::wrong_unit) != nullptr) ++reply->front();
  ChamberAnswer spoilt{Way::whole, *std::move(reply)};
  if (active(Kind::half) != nullptr) spoilt.way = Way::half;
  if (active(Kind::doubled) != nullptr) spoilt.way = Way::twice;
  if (const auto* const fault = active(Kind::late)) spoilt.delay = seconds(fault->value);
  return spoilt;
}

/// A read of one temperature is answered with the other; a write is done, and its reply names a
/// register two further on.
std::optional<Bytes> SimulatedChamber::answer_for_another(std::span<const std::uint8_t> request,
                                                          Instant now) {
  const auto decoded = modbus::decode_request(request);
  if (!decoded) return answer(request, now);
  if (modbus::is_write(*decoded)) {
    auto reply = answer(request, now);
    const bool carried_out = reply && reply->size() > address_at + 1;
    if (carried_out) put_address(*reply, static_cast<std::uint16_t>(decoded->address + 2));
    return reply;
  }
  Bytes other(request.begin(), request.end());
  const bool asks_actual = decoded->address == profile_.temperature_actual.address;
  put_address(other, asks_actual ? profile_.temperature_setpoint.address
                                 : profile_.temperature_actual.address);
  return answer(other, now);
}

const RigFault* SimulatedChamber::active(RigFaultKind kind) const {
  const auto found = std::find_if(active_.begin(), active_.end(),
                                  [kind](const RigFault& fault) { return fault.kind == kind; });
  return found == active_.end() ? nullptr : &*found;
}

void SimulatedChamber::begin(const RigFault& fault, Instant now) {
  switch (fault.kind) {
    case RigFaultKind::panel_setpoint:
      set_at_panel(Celsius{fault.value}, now);
      return;
    case RigFaultKind::panel_stop:
      set_at_panel(ChamberRun::stopped, now);
      return;
    case RigFaultKind::dead:
      set_at_panel(ChamberRun::stopped, now);
      break;
    case RigFaultKind::stuck:
      stuck_at_ = thermometer(now);
      break;
    default:
      break;
  }
  active_.push_back(fault);
}

void SimulatedChamber::end(const RigFault& fault) {
  const auto found = std::find(active_.begin(), active_.end(), fault);
  if (found != active_.end()) active_.erase(found);
}

Celsius SimulatedChamber::thermometer(Instant now) const {
  if (active(RigFaultKind::spurious_zero) != nullptr) return Celsius{0.0};
  if (active(RigFaultKind::stuck) != nullptr) return stuck_at_;
  const auto* const off = active(RigFaultKind::wrong_value);
  return off == nullptr ? actual(now) : actual(now) + Kelvin{off->value};
}

}  // namespace gyrocal
