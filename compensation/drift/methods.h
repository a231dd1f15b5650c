#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "compensation/drift/curve.h"

namespace gyrocal {

/// The paper's three first, then the references in temperature.
enum class Method {
  gm11,
  improved_gm11,
  least_squares,  ///< cubic in the index
  polynomial_1,   ///< in temperature, as the rest
  polynomial_2,
  polynomial_3,
  polynomial_4,
  polynomial_5,
  smoothing_spline,
};
[[nodiscard]] const std::vector<Method>& all_methods();
[[nodiscard]] const char* name_of(Method method);
/// @return unknown_name, with the list of known ones.
[[nodiscard]] Result<Method> method_named(std::string_view name);

/// Zero drifts at some of the setpoints of an axis: all of them, or what is left when some are
/// held out. The axis stays whole, so that holding out moves no other setpoint.
struct DriftSeries {
  IndexAxis axis;
  std::vector<std::size_t> position;  ///< in the axis, rising
  Eigen::VectorXd drift_dps;          ///< as many
  Eigen::VectorXd weight;  ///< empty, or 1 / variance; the paper's three methods know no weights

  [[nodiscard]] Eigen::VectorXd index() const;
  [[nodiscard]] Eigen::VectorXd temperature_c() const;
};

struct MethodSettings {
  int improved_degree = improved_degree_paper;  ///< 0 ... 5
  std::optional<double> spline_lambda;          ///< chosen by cross-validation when absent
};

/// What a method that is least squares in a polynomial fits to.
struct PolynomialDesign {
  Eigen::VectorXd x;       ///< index or temperature
  Eigen::VectorXd weight;  ///< empty or 1 / variance
  int degree;
};
/// Absent for the grey methods and the spline.
[[nodiscard]] std::optional<PolynomialDesign> polynomial_design(Method method,
                                                                const DriftSeries& series);

/// Fits one method. A grey method of a series with values <= 0 is fitted to the translated series
/// and the translation stored (grey/translation.h).
[[nodiscard]] Result<DriftCurve> fit_method(Method method, const DriftSeries& series,
                                            const MethodSettings& settings);

}  // namespace gyrocal
