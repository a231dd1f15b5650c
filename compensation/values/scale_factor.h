#pragma once

namespace gyrocal {

/// A board's scale factor on one axis: rate = count / (at_20_c + per_k * (T - 20 degC)).
/// The views of schema/views convert by the same expression.
struct ScaleFactor {
  double lsb_per_dps;            ///< at 20 degC [LSB/(deg/s)]
  double lsb_per_dps_per_k = 0;  ///< its change per kelvin
  /// @param board_c  the board's temperature; NaN counts as 20 degC.
  [[nodiscard]] constexpr double to_dps(double count_lsb, double board_c) const {
    const bool known = board_c == board_c;
    return count_lsb / (lsb_per_dps + lsb_per_dps_per_k * ((known ? board_c : 20.0) - 20.0));
  }
};

}  // namespace gyrocal
