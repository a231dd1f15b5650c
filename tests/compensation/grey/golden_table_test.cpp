// The paper's Table 1 through each model, held to numbers another program computed.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "compensation/grey/accuracy.h"
#include "compensation/grey/improved_gm11.h"

using namespace gyrocal;

namespace {

const nlohmann::json& golden() {
  static const auto data =
      nlohmann::json::parse(std::ifstream(GYROCAL_SOURCE_DIR "/tests/golden/paper_table1.json"));
  return data;
}

Eigen::VectorXd numbers(const nlohmann::json& list) {
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::span<const double> view(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

double largest_difference(const Eigen::VectorXd& fitted, const nlohmann::json& expected) {
  const Eigen::VectorXd values = numbers(expected);
  REQUIRE(fitted.size() == values.size());
  return (fitted - values).cwiseAbs().maxCoeff();
}

void check_accuracy(const Eigen::VectorXd& fitted, const nlohmann::json& expected) {
  const auto measured = numbers(golden()["zero_drift_dps"]);
  const auto found = accuracy(view(measured), view(fitted));
  CHECK(std::abs(found.rmse_n - expected["rmse_n"].get<double>()) < 1e-9);
  CHECK(std::abs(found.rmse_n_minus_1 - expected["rmse_n_minus_1"].get<double>()) < 1e-9);
  CHECK(std::abs(found.mae - expected["mae"].get<double>()) < 1e-9);
}

}  // namespace

TEST_CASE("GM(1,1) of Table 1 equals the golden numbers", "[grey][golden]") {
  const auto model = fit_gm11(numbers(golden()["zero_drift_dps"]));
  REQUIRE(model.has_value());
  CHECK(std::abs(model->a_per_step - golden()["gm11"]["a"].get<double>()) < 1e-9);
  CHECK(std::abs(model->b_dps - golden()["gm11"]["b"].get<double>()) < 1e-9);
  CHECK(largest_difference(model->fitted_dps, golden()["gm11"]["fitted"]) < 1e-9);
  check_accuracy(model->fitted_dps, golden()["gm11"]);
}

TEST_CASE("improved GM(1,1) of Table 1 equals the golden numbers", "[grey][golden]") {
  const auto model = fit_improved_gm11(numbers(golden()["zero_drift_dps"]));
  REQUIRE(model.has_value());
  CHECK(largest_difference(model->fitted_dps, golden()["improved_gm11"]["fitted"]) < 1e-9);
  check_accuracy(model->fitted_dps, golden()["improved_gm11"]);
}

TEST_CASE("a cubic in the index of Table 1 equals the golden numbers", "[grey][golden]") {
  const auto drift = numbers(golden()["zero_drift_dps"]);
  const auto index = plain_index(drift.size());
  const auto cubic = fit_polynomial(index, drift, 3);
  REQUIRE(cubic.has_value());
  const Eigen::VectorXd fitted = index.unaryExpr([&](double k) { return value_at(*cubic, k); });
  CHECK(largest_difference(fitted, golden()["least_squares_cubic_in_index"]["fitted"]) < 1e-9);
  check_accuracy(fitted, golden()["least_squares_cubic_in_index"]);
}
