#include "config/chamber_profile.h"

#include <fmt/core.h>

#include <array>
#include <string_view>

#include "config/text_file.h"
#include "config/toml_section.h"

namespace gyrocal {
namespace {

using namespace std::string_view_literals;

RegisterSpec read_register(TomlSection& table) {
  RegisterSpec spec;
  if (!table.has("address")) {
    table.expected("address", Errc::bad_input, "the 0-based wire address, 0 to 65535");
  }
  spec.address = static_cast<std::uint16_t>(table.integer("address", 0, {0, 65535}));
  constexpr std::array types{"int16"sv, "uint16"sv, "float32"sv};
  spec.type = static_cast<RegisterType>(table.choice("type", 2, types));
  constexpr std::array orders{"high_word_first"sv, "low_word_first"sv};
  spec.order = static_cast<WordOrder>(table.choice("order", 0, orders));
  spec.scale = table.number("scale", 1.0, {1e-6, 1e6});
  spec.read_function = static_cast<int>(table.integer("read_function", 3, {3, 4}));
  spec.write_function = static_cast<int>(table.integer("write_function", 16, {6, 16}));
  if (spec.write_function != 6 && spec.write_function != 16) {
    table.expected("write_function", Errc::out_of_range, "6 or 16");
  }
  if (spec.write_function == 6 && spec.type == RegisterType::float32) {
    table.expected("write_function", Errc::bad_input, "16: a float32 takes two registers");
  }
  return spec;
}

RegisterSpec read_value_register(TomlSection& registers, std::string_view key) {
  if (!registers.has(key)) {
    registers.expected(key, Errc::bad_input, fmt::format("a table [registers.{}]", key));
    return {};
  }
  auto table = registers.section(key);
  const auto spec = read_register(table);
  table.refuse_unknown_keys();
  return spec;
}

/// A register whose numbers stand for states; `states` are the names the drivers know.
std::optional<StateSpec> read_state_register(TomlSection& registers, std::string_view key,
                                             std::span<const std::string_view> states) {
  if (!registers.has(key)) return std::nullopt;
  auto table = registers.section(key);
  StateSpec spec;
  spec.reg = read_register(table);
  if (!table.has("values")) {
    table.expected("values", Errc::bad_input, fmt::format("a table [registers.{}.values]", key));
  }
  auto values = table.section("values");
  for (const auto state : states) {
    if (!values.has(state)) continue;
    spec.values[std::string(state)] = static_cast<int>(values.integer(state, 0, {-32768, 65535}));
  }
  values.refuse_unknown_keys();
  table.refuse_unknown_keys();
  return spec;
}

void read_limits(TomlSection& root, ChamberProfile& profile) {
  constexpr NumberRange physical{-273.15, 1000, "degC"};
  profile.limit_min.value = root.number("limit_min_c", profile.limit_min.value, physical);
  profile.limit_max.value = root.number("limit_max_c", profile.limit_max.value, physical);
  if (profile.limit_min >= profile.limit_max) {
    root.expected("limit_min_c", Errc::out_of_range,
                  fmt::format("less than limit_max_c, {}", profile.limit_max.value));
  }
  const auto rate = [&root](std::string_view key) -> std::optional<Kelvin> {
    if (!root.has(key)) return std::nullopt;
    return Kelvin{root.number(key, 1, {0.01, 100, "K/min"})};
  };
  profile.heating_per_minute = rate("heating_k_per_min");
  profile.cooling_per_minute = rate("cooling_k_per_min");
  profile.settle_after_write_s =
      root.number("settle_after_write_s", profile.settle_after_write_s, {0, 60, "s"});
  profile.read_back_tolerance.value =
      root.number("read_back_tolerance_k", profile.read_back_tolerance.value, {0, 5, "K"});
}

}  // namespace

Result<ChamberProfile> parse_chamber_profile(const std::string& text, const std::string& path) {
  auto file = TomlFile::parse(text, path);
  if (!file) return tl::unexpected(file.error());
  auto root = file->root();
  ChamberProfile profile;
  profile.text = text;
  profile.name = root.required_text("name", "what reports call this chamber");
  profile.description = root.text("description", "");
  profile.unit_default = static_cast<int>(root.integer("unit", 1, {0, 247}));
  read_limits(root, profile);

  auto registers = root.section("registers");
  profile.temperature_actual = read_value_register(registers, "temperature_actual");
  profile.temperature_setpoint = read_value_register(registers, "temperature_setpoint");
  constexpr std::array run_states{"stopped"sv, "running"sv, "paused"sv};
  constexpr std::array run_types{"constant"sv};
  profile.run_state = read_state_register(registers, "run_state", run_states);
  profile.run_command = read_state_register(registers, "run_command", run_states);
  profile.run_type = read_state_register(registers, "run_type", run_types);
  registers.refuse_unknown_keys();
  root.refuse_unknown_keys();
  if (const auto problems = file->problems()) return tl::unexpected(*problems);
  return profile;
}

Result<ChamberProfile> read_chamber_profile(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_chamber_profile(*text, path);
}

}  // namespace gyrocal
