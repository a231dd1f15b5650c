#include <catch2/catch.hpp>
#include <limits>

#include "compensation/grey/improved_gm11.h"

using namespace gyrocal;

namespace {

/// x0 of an exact GM(1,1): first value given, the rest x0(k) = beta - alpha x1(k - 1), which is
/// x0(k) + a z1(k) = b solved for x0(k).
Eigen::VectorXd exact_series(double a, double b, double first, Eigen::Index n) {
  Eigen::VectorXd x0(n);
  x0(0) = first;
  double x1 = first;
  for (Eigen::Index k = 1; k < n; ++k) {
    x0(k) = (b - a * x1) / (1 + 0.5 * a);
    x1 += x0(k);
  }
  return x0;
}

}  // namespace

TEST_CASE("GM(1,1) finds a and b of a series that obeys its equation", "[grey]") {
  const double a = GENERATE(-0.05, 0.003, 0.1);
  const auto model = fit_gm11(exact_series(a, 4.3, 4.4, 12));
  REQUIRE(model.has_value());
  CHECK(model->a_per_step == Approx(a).margin(1e-12));
  CHECK(model->b_dps == Approx(4.3).margin(1e-12));
}

TEST_CASE("a constant series is modelled by the constant", "[grey]") {
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(10, 4.25);
  const auto plain = fit_gm11(constant);
  const auto improved = fit_improved_gm11(constant);
  REQUIRE(plain.has_value());
  REQUIRE(improved.has_value());
  CHECK((plain->fitted_dps - constant).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((improved->fitted_dps - constant).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("at the setpoints the curve passes through the fitted values", "[grey]") {
  const Eigen::VectorXd drift =
      (Eigen::VectorXd(8) << 4.38, 4.33, 4.32, 4.34, 4.30, 4.27, 4.18, 4.22).finished();
  const auto plain = fit_gm11(drift);
  const auto improved = fit_improved_gm11(drift, 3);
  REQUIRE(plain.has_value());
  REQUIRE(improved.has_value());
  for (Eigen::Index i = 0; i < drift.size(); ++i) {
    CHECK(drift_at(*plain, static_cast<double>(i + 1)) == plain->fitted_dps(i));
    CHECK(drift_at(*improved, static_cast<double>(i + 1)) == improved->fitted_dps(i));
  }
}

TEST_CASE("a hole in a constant series changes nothing", "[grey]") {
  const Eigen::VectorXd index = (Eigen::VectorXd(6) << 1, 2, 4, 5, 6, 9).finished();
  const auto model = fit_gm11(index, Eigen::VectorXd::Constant(6, 2.0));
  REQUIRE(model.has_value());
  CHECK(drift_at(*model, 3.0) == Approx(2.0));
  CHECK(drift_at(*model, 7.5) == Approx(2.0));
}

TEST_CASE("a residual polynomial of degree 0 changes nothing: differencing removes it", "[grey]") {
  const Eigen::VectorXd drift =
      (Eigen::VectorXd(6) << 4.38, 4.33, 4.32, 4.34, 4.30, 4.27).finished();
  const auto plain = fit_gm11(drift);
  const auto shifted = fit_improved_gm11(drift, 0);
  REQUIRE(plain.has_value());
  REQUIRE(shifted.has_value());
  CHECK((plain->fitted_dps - shifted->fitted_dps).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("grey models refuse what they cannot model, and say why", "[grey][bad input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto code_of = [](const Eigen::VectorXd& drift) { return fit_gm11(drift).error().code; };
  CHECK(code_of(Eigen::VectorXd(0)) == Errc::too_few_points);
  CHECK(code_of(Eigen::VectorXd::Constant(1, 4.0)) == Errc::too_few_points);
  CHECK(code_of(Eigen::VectorXd::Constant(3, 4.0)) == Errc::too_few_points);
  CHECK(code_of(Eigen::Vector4d(4.1, nan, 4.0, 3.9)) == Errc::not_finite);
  CHECK(code_of(Eigen::Vector4d(4.1, 4.2, infinity, 3.9)) == Errc::not_finite);
  CHECK(code_of(Eigen::Vector4d(4.1, -0.1, 4.0, 3.9)) == Errc::out_of_range);
  CHECK(fit_gm11(Eigen::Vector4d(4.1, -0.1, 4.0, 3.9)).error().what ==
        "GM(1,1) needs a series >= 0 (Eq. 3); zero drift 2 of 4 is -0.1 deg/s");
  CHECK(fit_improved_gm11(Eigen::VectorXd::Constant(5, 4.0), 5).error().code ==
        Errc::too_few_points);
  CHECK(fit_improved_gm11(Eigen::VectorXd::Constant(9, 4.0), 6).error().code == Errc::out_of_range);
}
