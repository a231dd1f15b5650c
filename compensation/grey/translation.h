#pragma once

#include <Eigen/Core>
#include <vector>

namespace gyrocal {

/// What is added to a series before a grey fit, and taken off its fitted values again: 0 where
/// every value is > 0; otherwise the least translation for which every class ratio lies in the
/// band below, plus the range of the series. GM(1,1) is not invariant under it, which is why it is
/// stored with the model.
/// @param drift_dps  n values, finite; 0 for none.
[[nodiscard]] double translation_for(const Eigen::Ref<const Eigen::VectorXd>& drift_dps);

/// The class-ratio check: GM(1,1) suits a series whose ratios x0(k-1) / x0(k) all lie inside
/// (exp(-2 / (n + 1)), exp(2 / (n + 1))).
struct ClassRatios {
  double low = 0, high = 0;          ///< the band
  std::vector<double> ratio;         ///< n - 1; NaN or infinite next to a zero
  std::vector<std::size_t> outside;  ///< k (from 0, >= 1) whose ratio x0(k-1) / x0(k) is not inside
};
[[nodiscard]] ClassRatios class_ratios(const Eigen::Ref<const Eigen::VectorXd>& drift_dps);

}  // namespace gyrocal
