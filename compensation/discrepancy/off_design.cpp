#include "compensation/discrepancy/off_design.h"

#include <Eigen/QR>

namespace gyrocal {

OffDesign::OffDesign(const SlowModel& model, const SlowNoiseShape& noise)
    : whitener_(model.stream().grid(), noise) {
  const Eigen::MatrixXd white = whitener_.whiten(model.design());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
  basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(white.rows(), white.cols());
}

Eigen::MatrixXd OffDesign::off_white(const Eigen::MatrixXd& white) const {
  return white - basis_ * (basis_.transpose() * white);
}

Eigen::MatrixXd OffDesign::off(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  return off_white(whitener_.whiten(columns));
}

}  // namespace gyrocal
