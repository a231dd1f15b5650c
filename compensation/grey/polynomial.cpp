#include "compensation/grey/polynomial.h"

#include <fmt/core.h>

#include <Eigen/QR>
#include <cmath>

#include "compensation/values/assert.h"

namespace gyrocal {
namespace {

using QR = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

/// Powers of the centred and scaled x, their rows weighed, as QR.
struct Design {
  double centre;
  double scale;
  QR qr;
};

Result<Design> design_of(const Eigen::Ref<const Eigen::VectorXd>& x, int degree,
                         const Eigen::VectorXd& weights) {
  GYROCAL_ASSERT(degree >= 0 && (weights.size() == 0 || weights.size() == x.size()));
  const Eigen::Index n = x.size();
  if (n < degree + 1) {
    return fail(
        Errc::too_few_points,
        fmt::format("a polynomial of degree {} needs {} points, got {}", degree, degree + 1, n),
        "measure more setpoints or lower the degree");
  }
  if (!x.allFinite() || !weights.allFinite()) {
    return fail(Errc::not_finite, "a point to fit is NaN or infinite", "remove or repeat it");
  }
  const double centre = x.mean();
  const double spread = std::sqrt((x.array() - centre).square().sum() /
                                  static_cast<double>(std::max<Eigen::Index>(n - 1, 1)));
  const double scale = spread > 0 ? spread : 1.0;
  Eigen::MatrixXd powers(n, degree + 1);
  powers.col(0).setOnes();
  for (int j = 1; j <= degree; ++j) {
    powers.col(j) = powers.col(j - 1).array() * (x.array() - centre) / scale;
  }
  if (weights.size() != 0) powers = weights.cwiseSqrt().asDiagonal() * powers;
  Design design{centre, scale, QR(powers)};
  if (design.qr.rank() < degree + 1) {
    return fail(Errc::too_few_points,
                fmt::format("a polynomial of degree {} is not determined: the {} points carry only "
                            "{} independent conditions",
                            degree, n, design.qr.rank()),
                "measure more different setpoints or lower the degree");
  }
  return design;
}

}  // namespace

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
  GYROCAL_ASSERT(x.size() == y.size());
  if (!y.allFinite()) {
    return fail(Errc::not_finite, "a point to fit is NaN or infinite", "remove or repeat it");
  }
  const auto design = design_of(x, degree, weights);
  if (!design) return tl::unexpected(design.error());
  const Eigen::VectorXd right = weights.size() == 0
                                    ? Eigen::VectorXd(y)
                                    : Eigen::VectorXd(y.cwiseProduct(weights.cwiseSqrt()));
  return Polynomial{design->centre, design->scale, design->qr.solve(right)};
}

Result<Eigen::MatrixXd> polynomial_hat_matrix(const Eigen::Ref<const Eigen::VectorXd>& x,
                                              int degree, const Eigen::VectorXd& weights) {
  const auto design = design_of(x, degree, weights);
  if (!design) return tl::unexpected(design.error());
  const Eigen::MatrixXd q =
      design->qr.householderQ() * Eigen::MatrixXd::Identity(x.size(), degree + 1);
  Eigen::MatrixXd hat = q * q.transpose();
  if (weights.size() != 0) {
    const Eigen::VectorXd root = weights.cwiseSqrt();
    hat = root.cwiseInverse().asDiagonal() * hat * root.asDiagonal();
  }
  return hat;
}

}  // namespace gyrocal
