#pragma once

#include "config/chamber_profile.h"

namespace gyrocal {

/// The Yinhe map of the chamber fact sheet: float32, high word first; PV 160, SV 1742, run 200,
/// type 202; functions 3 and 16.
inline ChamberProfile yinhe_profile() {
  const auto word = [](std::uint16_t address) {
    return RegisterSpec{address, RegisterType::uint16, WordOrder::high_word_first, 1.0, 3, 16};
  };
  ChamberProfile profile;
  profile.name = "yinhe";
  profile.temperature_actual.address = 160;
  profile.temperature_setpoint.address = 1742;
  profile.run_state = StateSpec{word(200), {{"stopped", 0}, {"running", 1}, {"paused", 2}}};
  profile.run_command = profile.run_state;
  profile.run_type = StateSpec{word(202), {{"constant", 0}, {"program", 1}}};
  return profile;
}

/// A Samwontech-like map: int16 in 0.01 degC, function 6 to write, state and command in two
/// registers with numbers of their own, no run type.
inline ChamberProfile hundredths_profile() {
  const auto hundredths = [](std::uint16_t address) {
    return RegisterSpec{address, RegisterType::int16, WordOrder::high_word_first, 0.01, 3, 6};
  };
  const auto word = [](std::uint16_t address) {
    return RegisterSpec{address, RegisterType::uint16, WordOrder::high_word_first, 1.0, 3, 6};
  };
  ChamberProfile profile;
  profile.name = "hundredths";
  profile.temperature_actual = hundredths(1);
  profile.temperature_setpoint = hundredths(102);
  profile.run_state = StateSpec{word(10), {{"stopped", 0}, {"running", 1}}};
  profile.run_command = StateSpec{word(101), {{"stopped", 4}, {"running", 1}}};
  return profile;
}

}  // namespace gyrocal
