#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// How a value lies in the registers of a chamber.
enum class RegisterType { int16, uint16, float32 };
enum class WordOrder { high_word_first, low_word_first };

/// One value of a chamber's register map: where it lies and how it is read and written.
struct RegisterSpec {
  std::uint16_t address = 0;  ///< wire address, 0-based
  RegisterType type = RegisterType::float32;
  WordOrder order = WordOrder::high_word_first;  ///< float32 only
  double scale = 1.0;                            ///< physical value = raw * scale
  int read_function = 3;                         ///< 3 or 4
  int write_function = 16;                       ///< 6 or 16
  bool operator==(const RegisterSpec&) const = default;
};

/// An enumerated register: run state or run type. The numbers a command writes can differ from
/// those a state reads back.
struct StateSpec {
  RegisterSpec reg;
  std::map<std::string, int> values;  ///< state: "stopped" "running" "paused", or "constant"
};

/// A chamber's register map and limits as data: config/chambers/NAME.toml.
struct ChamberProfile {
  std::string name;
  std::string description;
  int unit_default = 1;
  RegisterSpec temperature_actual;
  RegisterSpec temperature_setpoint;
  std::optional<StateSpec> run_state;    ///< read
  std::optional<StateSpec> run_command;  ///< written; the same register on a Yinhe
  std::optional<StateSpec> run_type;     ///< "constant": what must stand there for setpoints to act
  Celsius limit_min{-60};
  Celsius limit_max{90};
  std::optional<Kelvin> heating_per_minute;  ///< the steepest it usually goes, if known
  std::optional<Kelvin> cooling_per_minute;
  double settle_after_write_s = 0.2;  ///< quiet time the controller needs after a write
  Kelvin read_back_tolerance{0.05};
  std::string text;  ///< the file as read: provenance
};

/// Reads a profile, config/chambers/NAME.toml.
/// @return storage, bad_input, unknown_name, out_of_range, not_finite; `what` names file, line,
/// key.
[[nodiscard]] Result<ChamberProfile> read_chamber_profile(const std::string& path);

/// Same, from text; `path` only names it in messages.
[[nodiscard]] Result<ChamberProfile> parse_chamber_profile(const std::string& text,
                                                           const std::string& path);

}  // namespace gyrocal
