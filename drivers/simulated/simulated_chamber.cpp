#include "drivers/simulated/simulated_chamber.h"

#include <algorithm>
#include <cmath>

#include "compensation/values/assert.h"
#include "drivers/chamber/register_value.h"

namespace gyrocal {
namespace {

double campaign_s(Instant now) { return to_seconds(now.time_since_epoch()); }

ChamberRun run_named(const std::string& name) {
  if (name == "running") return ChamberRun::running;
  return name == "paused" ? ChamberRun::paused : ChamberRun::stopped;
}

/// The state's name whose number is `value`; nothing if the profile knows none.
std::optional<std::string> state_with(const StateSpec& states, double value) {
  for (const auto& [name, number] : states.values) {
    if (number == value) return name;
  }
  return {};
}

}  // namespace

SimulatedChamber::SimulatedChamber(const ChamberProfile& profile, int unit, rig::ChamberAir& air)
    : profile_(profile), unit_(unit), air_(air) {
  fields_.push_back({Quantity::actual, profile_.temperature_actual});
  fields_.push_back({Quantity::setpoint, profile_.temperature_setpoint});
  if (profile_.run_state) fields_.push_back({Quantity::run_state, profile_.run_state->reg});
  if (profile_.run_command) fields_.push_back({Quantity::run_command, profile_.run_command->reg});
  if (profile_.run_type) fields_.push_back({Quantity::run_type, profile_.run_type->reg});
  if (!profile_.run_command) set_at_panel(ChamberRun::running, Instant{});
}

std::optional<Bytes> SimulatedChamber::answer(std::span<const std::uint8_t> request, Instant now) {
  if (request.size() < 2 || request[0] != unit_) return {};
  const auto reply = carry_out(request, now);
  return reply ? *reply : modbus::encode_exception(request[0], request[1], reply.error());
}

tl::expected<Bytes, modbus::Exception> SimulatedChamber::carry_out(
    std::span<const std::uint8_t> bytes, Instant now) {
  const auto request = modbus::decode_request(bytes);
  if (!request) return Refusal(request.error());
  if (!modbus::is_write(*request)) {
    const auto words = read(*request, now);
    if (!words) return Refusal(words.error());
    return modbus::encode_read_reply(*request, *words);
  }
  const auto writes = checked_writes(*request);
  if (!writes) return Refusal(writes.error());
  for (const Write& write : *writes) apply(write);
  act(now);
  return modbus::encode_write_reply(*request);
}

tl::expected<modbus::Words, modbus::Exception> SimulatedChamber::read(
    const modbus::Request& request, Instant now) const {
  modbus::Words words;
  for (int i = 0; i < request.count; ++i) {
    const auto address = static_cast<std::uint16_t>(request.address + i);
    const Field* const field = field_at(address, request.function);
    if (field == nullptr) return Refusal(modbus::Exception::illegal_address);
    const auto value = value_of(*field, now);
    if (!value) return Refusal(modbus::Exception::device_failure);
    const auto encoded = encode_value(field->reg, *value);
    if (!encoded) return Refusal(modbus::Exception::device_failure);
    words.push_back(encoded->at(static_cast<std::size_t>(address - field->reg.address)));
  }
  return words;
}

tl::expected<std::vector<SimulatedChamber::Write>, modbus::Exception>
SimulatedChamber::checked_writes(const modbus::Request& request) const {
  std::vector<Write> writes;
  for (std::size_t i = 0; i < request.values.size();) {
    const auto address = static_cast<std::uint16_t>(request.address + i);
    const Field* const field = field_at(address, request.function);
    if (field == nullptr || field->reg.address != address) {
      return Refusal(modbus::Exception::illegal_address);
    }
    const std::size_t count = word_count(field->reg.type);
    if (i + count > request.values.size()) return Refusal(modbus::Exception::illegal_address);
    const auto value = decode_value(field->reg, std::span(request.values).subspan(i, count));
    if (!value || !acceptable(*field, *value)) return Refusal(modbus::Exception::illegal_value);
    writes.push_back({field, *value});
    i += count;
  }
  return writes;
}

bool SimulatedChamber::acceptable(const Field& field, double value) const {
  if (field.quantity == Quantity::setpoint) {
    return value >= profile_.limit_min.value && value <= profile_.limit_max.value;
  }
  return state_with(states_of(field.quantity), value).has_value();
}

const SimulatedChamber::Field* SimulatedChamber::field_at(std::uint16_t address,
                                                          std::uint8_t function) const {
  const bool reading =
      function == modbus::read_holding_registers || function == modbus::read_input_registers;
  const auto here = [&](const Field& field) {
    const int into = address - field.reg.address;
    if (into < 0 || into >= word_count(field.reg.type)) return false;
    if (reading) return field.reg.read_function == function;
    const bool measured =
        field.quantity == Quantity::actual || field.quantity == Quantity::run_state;
    return !measured && field.reg.write_function == function;
  };
  const auto found = std::find_if(fields_.begin(), fields_.end(), here);
  return found == fields_.end() ? nullptr : &*found;
}

const StateSpec& SimulatedChamber::states_of(Quantity quantity) const {
  const auto& states = quantity == Quantity::run_state     ? profile_.run_state
                       : quantity == Quantity::run_command ? profile_.run_command
                                                           : profile_.run_type;
  GYROCAL_ASSERT(states.has_value());
  return *states;
}

std::optional<double> SimulatedChamber::value_of(const Field& field, Instant now) const {
  if (field.quantity == Quantity::actual) return thermometer(now).value;
  if (field.quantity == Quantity::setpoint) return setpoint_.value;
  const auto& values = states_of(field.quantity).values;
  const auto found = values.find(field.quantity == Quantity::run_type ? type_ : name_of(run_));
  if (found == values.end()) return {};
  return found->second;
}

void SimulatedChamber::apply(const Write& write) {
  if (write.field->quantity == Quantity::setpoint) {
    setpoint_ = Celsius{write.value};
    return;
  }
  const auto name = state_with(states_of(write.field->quantity), write.value);
  GYROCAL_ASSERT(name.has_value());
  if (write.field->quantity == Quantity::run_type) {
    type_ = *name;
  } else {
    run_ = run_named(*name);
  }
}

void SimulatedChamber::act(Instant now) {
  const double t_s = campaign_s(now);
  if (run_ == ChamberRun::stopped) {
    air_.stop(t_s);
  } else if (run_ == ChamberRun::running && type_ == "constant") {
    air_.run(t_s, setpoint_);
  } else {  // paused, or a program of its own: what there is, is held
    air_.run(t_s, air_.at(t_s));
  }
}

void SimulatedChamber::set_at_panel(Celsius setpoint, Instant now) {
  GYROCAL_ASSERT(std::isfinite(setpoint.value));
  setpoint_ = setpoint;
  act(now);
}

void SimulatedChamber::set_at_panel(ChamberRun run, Instant now) {
  run_ = run;
  act(now);
}

Celsius SimulatedChamber::actual(Instant now) const { return air_.at(campaign_s(now)); }

}  // namespace gyrocal
