#pragma once

#include <string_view>

#include "compensation/values/units.h"

namespace gyrocal::cli {

/// The axis of a name that is known to be "x", "y" or "z".
[[nodiscard]] constexpr Axis axis_named(std::string_view name) {
  return name == "x" ? Axis::x : name == "y" ? Axis::y : Axis::z;
}

}  // namespace gyrocal::cli
