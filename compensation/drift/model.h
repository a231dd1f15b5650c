#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compensation/grey/accuracy.h"
#include "compensation/grey/grade.h"
#include "compensation/values/error.h"
#include "compensation/values/units.h"

namespace gyrocal {

/// One value, or a list where the parameter is a list (a list of one stays a list of one only by
/// its name: setpoints_c and the coefficients are lists, all others single values).
struct NamedParameter {
  std::string name;
  std::vector<double> values;
  bool operator==(const NamedParameter&) const = default;
};

/// A model of zero drift over temperature as plain data: what is printed, stored and read back.
/// `parameters` alone evaluate it (evaluate() below); the rest says how good it is.
struct FittedModel {
  std::string method;                      ///< "gm11", "improved_gm11", "least_squares", ...
  std::vector<NamedParameter> parameters;  ///< in a fixed order for each method
  std::vector<double> setpoint_c;          ///< the n setpoints it was fitted to
  std::vector<double> measured_dps;        ///< n zero drifts it was fitted to
  std::vector<double> fitted_dps;          ///< n values of the model at the setpoints
  Accuracy training;                       ///< of fitted against measured: it flatters
  std::vector<double> held_out_dps;   ///< n predictions, each of a fit that lacked its setpoint
  double loocv_rmse_dps = 0;          ///< their RMSE (divisor n); NaN: too few points to hold out
  double block_rmse_dps = 0;          ///< as above with both neighbours left out as well
  std::vector<double> band_dps;       ///< n half widths of the 95 % prediction band; NaN: unknown
  double effective_parameters = 0;    ///< trace of d fitted / d measured
  std::optional<GreyGrade> grade;     ///< grey models of a series that is not constant
  std::vector<std::string> warnings;  ///< sentences
};

enum class Extrapolation { refuse, allow };

/// The model's zero drift [deg/s] at a temperature, from `parameters` alone. For many temperatures
/// build a DriftCurve (curve.h) once.
/// @return out_of_range outside the setpoints unless told to go on; bad_input when parameters are
///         missing or do not fit together, unknown_name for another method.
[[nodiscard]] Result<double> evaluate(const FittedModel& model, Celsius temperature,
                                      Extrapolation outside = Extrapolation::refuse);

}  // namespace gyrocal
