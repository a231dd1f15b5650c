#pragma once

#include <string>

#include "compensation/values/error.h"
#include "compensation/values/records.h"

namespace gyrocal::cli {

struct MeasuredTable {
  DriftTable table;
  std::vector<double> standard_error_dps;  ///< empty when the file has no such column
};

/// Columns temperature_c and zero_drift_dps, in any order and among others; standard_error_dps
/// where known. "-" is standard input.
/// @return what csv_columns.h refuses, and temperatures that do not rise strictly (the grey index
///         counts setpoints in order), each with file, line and column.
[[nodiscard]] Result<MeasuredTable> read_drift_table(const std::string& path);

}  // namespace gyrocal::cli
