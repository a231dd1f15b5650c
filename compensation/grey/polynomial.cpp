#include "compensation/grey/polynomial.h"

#include <fmt/core.h>

#include <Eigen/QR>
#include <cmath>

#include "compensation/values/assert.h"

namespace gyrocal {

double value_at(const Polynomial& polynomial, double x) {
  const double z = (x - polynomial.centre) / polynomial.scale;
  double sum = 0;
  for (Eigen::Index j = polynomial.coefficients.size(); j-- > 0;) {
    sum = sum * z + polynomial.coefficients(j);
  }
  return sum;
}

Result<Polynomial> fit_polynomial(const Eigen::Ref<const Eigen::VectorXd>& x,
                                  const Eigen::Ref<const Eigen::VectorXd>& y, int degree,
                                  const Eigen::VectorXd& weights) {
  GYROCAL_ASSERT(x.size() == y.size() && degree >= 0);
  GYROCAL_ASSERT(weights.size() == 0 || weights.size() == x.size());
  const Eigen::Index n = x.size();
  if (n < degree + 1) {
    return fail(
        Errc::too_few_points,
        fmt::format("a polynomial of degree {} needs {} points, got {}", degree, degree + 1, n),
        "measure more setpoints or lower the degree");
  }
  if (!x.allFinite() || !y.allFinite() || !weights.allFinite()) {
    return fail(Errc::not_finite, "a point to fit is NaN or infinite", "remove or repeat it");
  }
  Polynomial fitted;
  fitted.centre = x.mean();
  const double spread = std::sqrt((x.array() - fitted.centre).square().sum() /
                                  static_cast<double>(std::max<Eigen::Index>(n - 1, 1)));
  fitted.scale = spread > 0 ? spread : 1.0;

  Eigen::MatrixXd powers(n, degree + 1);
  powers.col(0).setOnes();
  for (int j = 1; j <= degree; ++j) {
    powers.col(j) = powers.col(j - 1).array() * (x.array() - fitted.centre) / fitted.scale;
  }
  Eigen::VectorXd right = y;
  if (weights.size() != 0) {
    const Eigen::VectorXd root = weights.cwiseSqrt();
    powers = root.asDiagonal() * powers;
    right = right.cwiseProduct(root);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(powers);
  if (qr.rank() < degree + 1) {
    return fail(Errc::too_few_points,
                fmt::format("a polynomial of degree {} is not determined: the {} points carry only "
                            "{} independent conditions",
                            degree, n, qr.rank()),
                "measure more different setpoints or lower the degree");
  }
  fitted.coefficients = qr.solve(right);
  return fitted;
}

}  // namespace gyrocal
