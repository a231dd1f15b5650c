#pragma once

#include <array>

#include "compensation/values/records.h"

namespace gyrocal {

/// Table 1 of the paper (Sensors & Transducers 2014, wavelet transform and improved grey
/// prediction): 25 zero drifts of one axis of an iNEMO V2, -10 to 50 degC.
[[nodiscard]] const DriftTable& paper_table_1();

/// One row of the paper's Table 2, as printed there and as its own text and a recomputation from
/// Table 1 have it. The two differ where figures were swapped.
struct PaperFigures {
  const char* method;  ///< our name of the method
  const char* title;   ///< the paper's
  double rmse_printed_dps, mae_printed_dps;
  double rmse_text_dps, mae_text_dps;
  bool rmse_divides_by_n;  ///< else by n - 1: the paper mixes both
};

/// Table 2, in its order. Section 5.5 prints the grey MAE as "0.384": 0.0384 with a zero lost.
inline constexpr std::array<PaperFigures, 3> paper_table_2{{
    {"gm11", "Grey prediction", 0.0445, 0.0306, 0.0445, 0.0384, true},
    {"least_squares", "Least square method", 0.0384, 0.0264, 0.0306, 0.0264, false},
    {"improved_gm11", "Improved grey prediction", 0.0250, 0.0180, 0.0250, 0.0180, false},
}};

/// Section 5.3: the standard deviation of a dwell before and after the filter.
inline constexpr double paper_raw_deviation_dps = 1.3102;
inline constexpr double paper_filtered_deviation_dps = 0.2488;

}  // namespace gyrocal
