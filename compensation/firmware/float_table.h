#pragma once

#include <vector>

#include "compensation/drift/curve.h"

namespace gyrocal {

/// Zero drift in single precision over strictly rising temperatures, straight lines between: what a
/// microcontroller can hold and evaluate without a library.
struct FloatTable {
  std::vector<float> temperature_c;  ///< at least 2
  std::vector<float> drift_dps;      ///< as many
  bool operator==(const FloatTable&) const = default;
};

/// Rows at every setpoint (a grey curve bends there) and in between wherever the straight line
/// would leave the curve by more than `tolerance_dps`; never more than 32 rows a step.
[[nodiscard]] FloatTable tabulated(const DriftCurve& curve, double tolerance_dps);

/// The exported C function, operation by operation: in single precision as the target has it, in
/// double to see what single precision costs. Outside the table the end value; NaN gives the lowest
/// row.
[[nodiscard]] float value_at(const FloatTable& table, float temperature_c);
[[nodiscard]] double value_at(const FloatTable& table, double temperature_c);

}  // namespace gyrocal
