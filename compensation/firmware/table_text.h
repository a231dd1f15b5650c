#pragma once

#include "compensation/firmware/c_header.h"

namespace gyrocal {

/// board,axis,temperature_scale,temperature_c,zero_drift_dps: the identity in every row, because a
/// CSV has no other place for it.
[[nodiscard]] std::string csv_text(std::span<const AxisTable> axes);
[[nodiscard]] Result<std::vector<AxisTable>> read_csv_text(std::string_view text);

/// {"format":"gyrocal-zero-drift/1","board","temperature_scale","comment":[lines],
///  "axes":[{"axis","temperature_c":[...],"zero_drift_dps":[...]}]}
[[nodiscard]] std::string json_text(std::span<const AxisTable> axes, std::string_view comment);
/// Reads what json_text wrote, and only that.
[[nodiscard]] Result<std::vector<AxisTable>> read_json_text(std::string_view text);

}  // namespace gyrocal
