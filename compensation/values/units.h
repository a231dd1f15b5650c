#pragma once

#include <compare>
#include <cstdint>
#include <numbers>

namespace gyrocal {

/// A temperature difference [K]; one kelvin is one degree Celsius of difference.
struct Kelvin {
  double value;
  auto operator<=>(const Kelvin&) const = default;
};
/// A temperature [degC].
struct Celsius {
  double value;
  auto operator<=>(const Celsius&) const = default;
};
constexpr Kelvin operator-(Celsius a, Celsius b) { return {a.value - b.value}; }
constexpr Celsius operator+(Celsius t, Kelvin d) { return {t.value + d.value}; }
constexpr Celsius operator-(Celsius t, Kelvin d) { return {t.value - d.value}; }

inline constexpr double rad_per_deg = std::numbers::pi / 180;

/// Row numbers of the database, kept apart by type.
enum class CampaignId : std::int64_t {};
enum class BoardId : std::int64_t {};
enum class DwellId : std::int64_t {};
enum class RigModelId : std::int64_t {};

/// The three gyro axes in the order of the board's data frame: X roll, Y pitch, Z yaw.
enum class Axis : std::uint8_t { x = 0, y = 1, z = 2 };
inline constexpr Axis all_axes[] = {Axis::x, Axis::y, Axis::z};
constexpr char letter(Axis axis) { return "xyz"[static_cast<int>(axis)]; }

}  // namespace gyrocal
