#pragma once

#include <Eigen/Core>

#include "compensation/discrepancy/slow_search.h"

namespace gyrocal {

/// Columns as the present model's noise whitens them, what its design can make taken off: what a
/// column has left is evidence, the rest is none.
class OffDesign {
 public:
  OffDesign(const SlowModel& model, const SlowNoiseShape& noise);

  [[nodiscard]] const SlowWhitener& whitener() const { return whitener_; }
  /// @param white  columns already whitened.
  [[nodiscard]] Eigen::MatrixXd off_white(const Eigen::MatrixXd& white) const;
  [[nodiscard]] Eigen::MatrixXd off(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;

 private:
  SlowWhitener whitener_;
  Eigen::MatrixXd basis_;
};

}  // namespace gyrocal
