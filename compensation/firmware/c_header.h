#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compensation/drift/identity.h"
#include "compensation/firmware/float_table.h"

namespace gyrocal {

/// One axis of an export that carries tables.
struct AxisTable {
  SensorIdentity identity;
  FloatTable table;
  bool operator==(const AxisTable&) const = default;
};

/// A C99 header of its own: tables, one function an axis, nothing included. The function gives the
/// end value outside the table's range and says so by its return value.
/// @param axes     1 to 3, of one board and one temperature scale, each axis once.
/// @param comment  lines for the head of the file, without comment signs.
[[nodiscard]] std::string c_header_text(std::span<const AxisTable> axes, std::string_view comment);
/// @return bad_input when the text is not such a header.
[[nodiscard]] Result<std::vector<AxisTable>> read_c_header(std::string_view text);

}  // namespace gyrocal
