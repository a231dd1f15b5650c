#include "drivers/chamber/modbus_chamber.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "compensation/values/assert.h"
#include "drivers/chamber/register_value.h"

namespace gyrocal {
namespace {

constexpr int tries_max = 3;

bool is_passing(modbus::Exception exception) {
  return exception == modbus::Exception::busy || exception == modbus::Exception::acknowledge;
}

modbus::Request read_of(std::uint8_t unit, const RegisterSpec& reg) {
  return modbus::read_request(unit, static_cast<std::uint8_t>(reg.read_function), reg.address,
                              word_count(reg.type));
}

}  // namespace

ModbusChamber::ModbusChamber(RequestLink& link, Clock& clock, ChamberProfile profile, int unit)
    : link_(link),
      clock_(clock),
      profile_(std::move(profile)),
      unit_(static_cast<std::uint8_t>(unit)) {
  GYROCAL_ASSERT(unit >= 0 && unit <= 255);
}

Result<ChamberReading> ModbusChamber::read() {
  const auto actual = read_value(profile_.temperature_actual);
  if (!actual) return tl::unexpected(actual.error());
  const auto setpoint = read_value(profile_.temperature_setpoint);
  if (!setpoint) return tl::unexpected(setpoint.error());
  ChamberReading reading{Celsius{*actual}, Celsius{*setpoint}, {}, {}};
  if (profile_.run_state) {
    const auto run = read_run();
    if (!run) return tl::unexpected(run.error());
    reading.run = *run;
  }
  if (profile_.run_type) {
    const auto constant = number_of(*profile_.run_type, "constant");
    if (!constant) return tl::unexpected(constant.error());
    const auto type = read_number(profile_.run_type->reg);
    if (!type) return tl::unexpected(type.error());
    reading.constant_mode = *type == *constant;
  }
  return reading;
}

Result<ChamberRun> ModbusChamber::read_run() {
  const auto number = read_number(profile_.run_state->reg);
  if (!number) return tl::unexpected(number.error());
  constexpr std::pair<const char*, ChamberRun> states[] = {{"stopped", ChamberRun::stopped},
                                                           {"running", ChamberRun::running},
                                                           {"paused", ChamberRun::paused}};
  std::string known;
  for (const auto& [name, run] : states) {
    const auto entry = profile_.run_state->values.find(name);
    if (entry == profile_.run_state->values.end()) continue;
    if (entry->second == *number) return run;
    known += fmt::format("{}{} {}", known.empty() ? "" : ", ", entry->second, name);
  }
  return fail(Errc::bad_frame,
              fmt::format("run state register {} holds {}, known are {}",
                          profile_.run_state->reg.address, *number, known),
              fmt::format("complete the profile {}", profile_.name));
}

Result<void> ModbusChamber::set_setpoint(Celsius to) {
  if (!std::isfinite(to.value)) {
    return fail(Errc::not_finite, fmt::format("setpoint {} degC", to.value));
  }
  if (to < profile_.limit_min || to > profile_.limit_max) {
    return fail(Errc::out_of_range,
                fmt::format("setpoint {} degC, chamber {} goes from {} to {}", to.value,
                            profile_.name, profile_.limit_min.value, profile_.limit_max.value));
  }
  const RegisterSpec& reg = profile_.temperature_setpoint;
  double read_back = 0;
  for (int i = 0; i < tries_max; ++i) {
    const auto written = write_value(reg, to.value);
    if (!written) return tl::unexpected(written.error());
    const auto got = read_value(reg);
    if (!got) return tl::unexpected(got.error());
    if (std::abs(*got - *written) <= profile_.read_back_tolerance.value) return {};
    read_back = *got;
  }
  return fail(Errc::mismatch,
              fmt::format("setpoint {}: wrote {} {} times, read {}", reg.address, to.value,
                          tries_max, read_back),
              "does another master or the panel hold the chamber?");
}

Result<void> ModbusChamber::run() {
  if (profile_.run_type) {
    auto constant = reach(*profile_.run_type, *profile_.run_type, "constant");
    if (!constant) return constant;
  }
  return reach_run_state("running");
}

Result<void> ModbusChamber::stop() { return reach_run_state("stopped"); }

Result<void> ModbusChamber::reach_run_state(const std::string& state) {
  if (profile_.run_command) {
    return reach(*profile_.run_command, profile_.run_state.value_or(*profile_.run_command), state);
  }
  if (!profile_.run_state) return {};
  const auto wanted = number_of(*profile_.run_state, state);
  if (!wanted) return tl::unexpected(wanted.error());
  const auto shown = read_number(profile_.run_state->reg);
  if (!shown) return tl::unexpected(shown.error());
  if (*shown == *wanted) return {};
  return fail(Errc::refused,
              fmt::format("chamber {} is not {}, and its profile has no command for it",
                          profile_.name, state),
              "switch it on the panel");
}

Result<void> ModbusChamber::reach(const StateSpec& command, const StateSpec& shown,
                                  const std::string& state) {
  const auto to_write = number_of(command, state);
  if (!to_write) return tl::unexpected(to_write.error());
  const auto to_see = number_of(shown, state);
  if (!to_see) return tl::unexpected(to_see.error());
  int seen = 0;
  for (int i = 0;; ++i) {
    const auto number = read_number(shown.reg);
    if (!number) return tl::unexpected(number.error());
    if (*number == *to_see) return {};
    seen = *number;
    if (i == tries_max) break;
    const auto written = write_value(command.reg, *to_write);
    if (!written) return tl::unexpected(written.error());
  }
  return fail(Errc::mismatch,
              fmt::format("{}: wrote {} to register {} {} times, register {} reads {}", state,
                          *to_write, command.reg.address, tries_max, shown.reg.address, seen),
              "does another master or the panel hold the chamber?");
}

Result<modbus::Words> ModbusChamber::ask(const modbus::Request& request) {
  const Bytes bytes = modbus::encode_request(request);
  for (int i = 1;; ++i) {
    const auto reply = link_.transact(bytes);
    if (!reply) {
      return fail(reply.error().code, fmt::format("{}: {}", to_text(request), reply.error().what),
                  reply.error().advice);
    }
    const auto exception = modbus::exception_in(request, *reply);
    if (!exception || !is_passing(*exception) || i == tries_max) {
      return modbus::decode_reply(request, *reply);
    }
    settle();
  }
}

Result<double> ModbusChamber::read_value(const RegisterSpec& reg) {
  const auto words = ask(read_of(unit_, reg));
  if (!words) return tl::unexpected(words.error());
  return decode_value(reg, *words);
}

Result<int> ModbusChamber::read_number(const RegisterSpec& reg) {
  const auto value = read_value(reg);
  if (!value) return tl::unexpected(value.error());
  if (std::abs(*value) > 65535) {
    return fail(Errc::bad_frame, fmt::format("register {} holds {}, expected a state's number",
                                                reg.address, *value));
  }
  return static_cast<int>(std::lround(*value));
}

Result<double> ModbusChamber::write_value(const RegisterSpec& reg, double value) {
  auto words = encode_value(reg, value);
  if (!words) return tl::unexpected(words.error());
  auto rounded = decode_value(reg, *words);
  const auto request = modbus::write_request(unit_, static_cast<std::uint8_t>(reg.write_function),
                                             reg.address, std::move(*words));
  if (const auto done = ask(request); !done) return tl::unexpected(done.error());
  settle();
  return rounded;
}

Result<int> ModbusChamber::number_of(const StateSpec& spec, const std::string& state) const {
  const auto entry = spec.values.find(state);
  if (entry != spec.values.end()) return entry->second;
  return fail(Errc::unknown_name,
              fmt::format("profile {} has no number for \"{}\" at register {}", profile_.name,
                          state, spec.reg.address),
              "complete the profile");
}

void ModbusChamber::settle() {
  clock_.sleep_until(clock_.now() + seconds(profile_.settle_after_write_s));
}

}  // namespace gyrocal
