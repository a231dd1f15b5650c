#pragma once

#include <Eigen/Core>
#include <vector>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// What one law adds at each of its trial values, in bins.
struct ScanColumns {
  const rig::Effect* effect = nullptr;
  const rig::Law* law = nullptr;
  std::vector<std::vector<double>> rows;  ///< trial values, amplitude first
  Eigen::MatrixXd columns;                ///< one a row
};

/// Every law of the catalogue that can show in the slow stream.
[[nodiscard]] std::vector<ScanColumns> scan_columns(const SlowModel& model);

/// Gain of each column alone at fixed noise, the white level profiled out. A column that the
/// design can make by itself gains nothing.
/// @param white  whitened columns.  @param off  the same, what the design can make taken off.
/// @param y_off  the residual, so treated.
[[nodiscard]] Eigen::VectorXd column_gains(const Eigen::MatrixXd& white, const Eigen::MatrixXd& off,
                                           const Eigen::VectorXd& y_off);

}  // namespace gyrocal
