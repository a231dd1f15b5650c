#include "compensation/firmware/px4.h"

#include <fmt/format.h>

#include "compensation/firmware/text_scan.h"
#include "compensation/values/units.h"

namespace gyrocal {
namespace {

constexpr int mav_int32 = 6;
constexpr int mav_float = 9;

int axis_number(std::string_view axis) { return axis == "x" ? 0 : axis == "y" ? 1 : 2; }

std::string line(const std::string& name, const std::string& value, int type) {
  return fmt::format("1\t1\t{}\t{}\t{}\n", name, value, type);
}

std::string float_line(const std::string& name, double value) {
  return line(name, fmt::format("{:.9g}", static_cast<float>(value)), mav_float);
}

}  // namespace

float offset_rad_s(const Px4Gyro& gyro, float temperature_c) {
  float delta = temperature_c - gyro.tref;
  if (temperature_c > gyro.tmax) delta = gyro.tmax - gyro.tref;
  if (temperature_c < gyro.tmin) delta = gyro.tmin - gyro.tref;
  const float squared = delta * delta;
  const float cubed = squared * delta;
  return gyro.x[0] + gyro.x[1] * delta + gyro.x[2] * squared + gyro.x[3] * cubed;
}

std::string px4_text(std::span<const AxisCubic> axes, int instance,
                     std::optional<std::uint32_t> device_id, std::string_view comment) {
  std::string text;
  for (const auto row : lines_of(comment)) text += fmt::format("# {}\n", row);
  text += "#\n# Vehicle-Id Component-Id Name Value Type\n";
  const auto name = [&](std::string_view part) { return fmt::format("TC_G{}_{}", instance, part); };
  text += line("TC_G_ENABLE", "1", mav_int32);
  if (device_id) {
    // The parameter is a signed 32-bit number that holds the unsigned id's bits.
    text += line(name("ID"), fmt::format("{}", static_cast<std::int32_t>(*device_id)), mav_int32);
  }
  const Cubic& shared = axes.front().cubic;
  text += float_line(name("TREF"), shared.reference_c);
  text += float_line(name("TMIN"), shared.min_c);
  text += float_line(name("TMAX"), shared.max_c);
  for (const auto& [identity, cubic] : axes) {
    for (std::size_t j = 4; j-- > 0;) {
      text += float_line(name(fmt::format("X{}_{}", j, axis_number(identity.axis))),
                         cubic.dps[j] * rad_per_deg);
    }
  }
  return text;
}

Result<Px4Gyro> read_px4_text(std::string_view text, int instance, std::string_view axis) {
  std::string missing_name;
  const auto read = [&](const std::string& part) {
    const auto name = fmt::format("TC_G{}_{}", instance, part);
    const auto value = float_beside(text, name, '\t', 5, 2);
    if (!value) missing_name = name;
    return value.value_or(0.0F);
  };
  Px4Gyro gyro{read("TREF"), read("TMIN"), read("TMAX"), {}};
  for (std::size_t j = 0; j < 4; ++j) {
    gyro.x[j] = read(fmt::format("X{}_{}", j, axis_number(axis)));
  }
  if (missing_name.empty()) return gyro;
  return fail(Errc::bad_input, fmt::format("PX4 parameters: no readable {}", missing_name));
}

}  // namespace gyrocal
