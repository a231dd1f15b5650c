#pragma once

#include <string_view>
#include <variant>

#include "compensation/drift/index_axis.h"
#include "compensation/drift/model.h"
#include "compensation/drift/smoothing_spline.h"
#include "compensation/grey/improved_gm11.h"

namespace gyrocal {

/// The shapes a drift curve can have. The grey ones and IndexPolynomial live on the index axis,
/// the others on temperature.
struct IndexPolynomial {
  Polynomial polynomial;
};
struct TemperaturePolynomial {
  Polynomial polynomial;
};
using Shape = std::variant<Gm11, ImprovedGm11, IndexPolynomial, TemperaturePolynomial, Spline>;

/// A model ready to be evaluated.
struct DriftCurve {
  IndexAxis axis;
  Shape shape;
  double translation_dps = 0;  ///< was added before a grey fit, is taken off again here

  /// Without a range check.
  [[nodiscard]] double at(Celsius temperature) const;
};

/// The parameters that rebuild a curve, and the way back. curve_of checks names, lengths and
/// finiteness, since what it reads may come from a file: bad_input, unknown_name.
[[nodiscard]] std::vector<NamedParameter> parameters_of(const DriftCurve& curve);
[[nodiscard]] Result<DriftCurve> curve_of(std::string_view method,
                                          const std::vector<NamedParameter>& parameters);

/// One value of the curve, refusing to leave the setpoints unless told.
[[nodiscard]] Result<double> evaluate(const DriftCurve& curve, Celsius temperature,
                                      Extrapolation outside);

}  // namespace gyrocal
