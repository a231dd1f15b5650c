#pragma once

#include <span>

namespace gyrocal {

/// How far fitted values lie from the measured ones. The paper mixes divisors: its grey RMSE
/// divides by n, the other two by n - 1; so both are here.
struct Accuracy {
  double rmse_n = 0;          ///< sqrt(sum e^2 / n) [deg/s]
  double rmse_n_minus_1 = 0;  ///< sqrt(sum e^2 / (n - 1)) [deg/s]; NaN for one point
  double mae = 0;             ///< mean |e| [deg/s]
  double max = 0;             ///< largest |e| [deg/s]
  bool operator==(const Accuracy&) const = default;
};

/// @param measured_dps, fitted_dps  n >= 1 values each.
[[nodiscard]] Accuracy accuracy(std::span<const double> measured_dps,
                                std::span<const double> fitted_dps);

}  // namespace gyrocal
