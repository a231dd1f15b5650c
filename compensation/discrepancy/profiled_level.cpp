#include "compensation/discrepancy/profiled_level.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

namespace gyrocal {

ProfiledLevel profile_level(const Eigen::MatrixXd& white, double logs) {
  const Eigen::Index last = white.cols() - 1;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
  const double rss = std::pow(qr.matrixQR()(last, last), 2);
  const auto count = static_cast<double>(white.rows());
  ProfiledLevel result;
  result.white_variance = rss / count;
  result.log_likelihood =
      -0.5 * (count * (std::log(2 * std::numbers::pi * result.white_variance) + 1) + logs);
  return result;
}

}  // namespace gyrocal
