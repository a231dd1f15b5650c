#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/drift/methods.h"
#include "compensation/drift/model.h"
#include "compensation/values/records.h"

namespace gyrocal {

struct AnalysisOptions {
  std::vector<Method> methods = all_methods();
  int improved_degree = improved_degree_paper;  ///< 0 ... 5
  /// Standard error of each zero drift [deg/s], or empty. Enters the references in temperature as
  /// weights; the paper's three methods have none.
  std::vector<double> standard_error_dps;
};

struct RefusedMethod {
  std::string method;
  Error error;
};

/// Every method on one table, each with its honest errors.
struct Analysis {
  std::vector<FittedModel> models;         ///< in the order of the options
  std::vector<RefusedMethod> refused;      ///< methods this table is too small or too strange for
  std::optional<std::size_t> recommended;  ///< in `models`: smallest leave-one-out error
  std::string reason;                      ///< a sentence: why it, and what the others reach
  std::vector<std::string> warnings;       ///< about the table
};

/// @param table  n zero drifts [deg/s] over strictly rising setpoints; one row a setpoint
///               (setpoint_means() joins repeated ones). Pure: the same table and options give the
///               same numbers to the last bit.
/// @return not_finite, out_of_range (setpoints that do not rise, a standard error <= 0),
///         too_few_points when no method can be fitted, bad_input for lengths that differ.
[[nodiscard]] Result<Analysis> analyse(const DriftTable& table,
                                       const AnalysisOptions& options = {});

}  // namespace gyrocal
