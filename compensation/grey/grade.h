#pragma once

#include <optional>
#include <span>
#include <string>

namespace gyrocal {

/// The grade of grey theory. C = S2 / S1 with S1 the standard deviation of the series and S2 that
/// of the residuals; P the share of residuals with |e - mean e| < 0.6745 S1 (Deng 1982). Good:
/// C < 0.35 and P > 0.95; qualified: 0.5, 0.8; just qualified: 0.65, 0.7; else unqualified. Both
/// must hold.
struct GreyGrade {
  double posterior_error_ratio = 0;    ///< C
  double small_error_probability = 0;  ///< P, 0 ... 1
  std::string grade;
  bool operator==(const GreyGrade&) const = default;
};

/// @param measured, fitted  n >= 2 values each.
/// @return nothing for a constant series: S1 = 0 leaves C undefined.
[[nodiscard]] std::optional<GreyGrade> grey_grade(std::span<const double> measured,
                                                  std::span<const double> fitted);

}  // namespace gyrocal
