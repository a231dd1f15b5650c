#include "compensation/drift/analysis.h"

#include <Eigen/QR>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "compensation/drift/held_out.h"
#include "compensation/drift/paper.h"
#include "compensation/drift/sensitivity.h"
#include "config/drift_model/model_json.h"

using namespace gyrocal;

namespace {

const FittedModel& model_named(const Analysis& analysis, const std::string& name) {
  const auto found = std::find_if(analysis.models.begin(), analysis.models.end(),
                                  [&](const auto& m) { return m.method == name; });
  REQUIRE(found != analysis.models.end());
  return *found;
}

/// Leave-one-out residuals of a linear method without refitting: e_i / (1 - h_ii).
double loocv_by_hat_matrix(const Eigen::MatrixXd& design, const Eigen::VectorXd& y) {
  const Eigen::MatrixXd hat =
      design * (design.transpose() * design).ldlt().solve(design.transpose());
  const Eigen::VectorXd residual = y - hat * y;
  return std::sqrt((residual.array() / (1 - hat.diagonal().array())).square().mean());
}

Eigen::MatrixXd powers(const Eigen::VectorXd& x, int degree) {
  const Eigen::VectorXd z = (x.array() - x.mean()) / 10;
  Eigen::MatrixXd design(x.size(), degree + 1);
  for (int j = 0; j <= degree; ++j) design.col(j) = z.array().pow(j);
  return design;
}

Eigen::VectorXd vector_of(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

DriftTable constant_table(std::size_t n, double value) {
  DriftTable table;
  for (std::size_t i = 0; i < n; ++i) {
    table.temperature_c.push_back(10.0 * static_cast<double>(i));
    table.zero_drift_dps.push_back(value);
  }
  return table;
}

}  // namespace

TEST_CASE("the analysis of Table 1 equals the golden numbers", "[drift][golden]") {
  const auto golden =
      nlohmann::json::parse(std::ifstream(GYROCAL_SOURCE_DIR "/tests/golden/paper_table1.json"));
  REQUIRE(golden["temperature_c"].get<std::vector<double>>() == paper_table_1().temperature_c);
  REQUIRE(golden["zero_drift_dps"].get<std::vector<double>>() == paper_table_1().zero_drift_dps);
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  const std::pair<const char*, const char*> pairs[] = {
      {"gm11", "gm11"},
      {"improved_gm11", "improved_gm11"},
      {"least_squares", "least_squares_cubic_in_index"}};
  for (const auto& [ours, theirs] : pairs) {
    const auto& model = model_named(*analysis, ours);
    const auto fitted = golden[theirs]["fitted"].get<std::vector<double>>();
    CHECK((vector_of(model.fitted_dps) - vector_of(fitted)).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(std::abs(model.training.rmse_n - golden[theirs]["rmse_n"].get<double>()) < 1e-9);
    CHECK(std::abs(model.training.mae - golden[theirs]["mae"].get<double>()) < 1e-9);
  }
}

TEST_CASE("leave-one-out of the linear methods is that of their hat matrices", "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  const auto y = vector_of(paper_table_1().zero_drift_dps);
  const auto t = vector_of(paper_table_1().temperature_c);
  CHECK(model_named(*analysis, "least_squares").loocv_rmse_dps ==
        Approx(loocv_by_hat_matrix(powers(plain_index(25), 3), y)).epsilon(1e-9));
  for (int degree = 1; degree <= 5; ++degree) {
    const auto& model = model_named(*analysis, "polynomial_" + std::to_string(degree));
    CHECK(model.loocv_rmse_dps == Approx(loocv_by_hat_matrix(powers(t, degree), y)).epsilon(1e-9));
    CHECK(model.effective_parameters == Approx(degree + 1).epsilon(1e-6));
  }
}

TEST_CASE("held-out predictions of a polynomial are those of fits without the block", "[drift]") {
  const auto y = vector_of(paper_table_1().zero_drift_dps);
  const auto t = vector_of(paper_table_1().temperature_c);
  const auto axis = index_axis(paper_table_1().temperature_c).value();
  DriftSeries series{axis, std::vector<std::size_t>(25), y, {}};
  std::iota(series.position.begin(), series.position.end(), std::size_t{0});
  const Eigen::VectorXd uneven = Eigen::VectorXd::LinSpaced(25, 1, 9);
  for (const Eigen::VectorXd& weight : {Eigen::VectorXd(), uneven}) {
    series.weight = weight;
    for (const int neighbours : {0, 1}) {
      const auto predictions =
          held_out_predictions(Method::polynomial_3, series, {}, std::size_t(neighbours)).value();
      for (int i = 0; i < 25; ++i) {
        std::vector<int> kept;
        for (int j = 0; j < 25; ++j) {
          if (std::abs(j - i) > neighbours) kept.push_back(j);
        }
        const Eigen::VectorXd kept_weight =
            weight.size() == 0 ? weight : Eigen::VectorXd(weight(kept));
        const auto refitted = fit_polynomial(t(kept), y(kept), 3, kept_weight).value();
        CHECK(predictions[std::size_t(i)] == Approx(value_at(refitted, t(i))).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("the model with the smallest held-out error is recommended, in a sentence", "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  REQUIRE(analysis->recommended.has_value());
  const auto& best = analysis->models[*analysis->recommended];
  for (const auto& model : analysis->models) CHECK(best.loocv_rmse_dps <= model.loocv_rmse_dps);
  CHECK(analysis->reason.starts_with(
      best.method + " predicts setpoints it has not seen best: leave-one-out error 0.0318 deg/s"));
}

TEST_CASE("held out, every method but interpolation errs more than on its training data",
          "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  for (const auto& model : analysis->models) {
    CAPTURE(model.method);
    CHECK(model.loocv_rmse_dps > model.training.rmse_n);
    CHECK(model.block_rmse_dps > model.loocv_rmse_dps);
  }
}

TEST_CASE("the 95 % band holds 95 % of new zero drifts", "[drift][property]") {
  const auto seed = GENERATE(1u, 2u);
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.02);
  const auto truth = [](double t) { return 4.2 - 0.004 * t + 2e-5 * t * t; };
  DriftTable table = paper_table_1();
  AnalysisOptions options;
  options.methods = {Method::polynomial_2};
  int inside = 0;
  int trials = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    for (std::size_t i = 0; i < table.temperature_c.size(); ++i) {
      table.zero_drift_dps[i] = truth(table.temperature_c[i]) + noise(random);
    }
    const auto analysis = analyse(table, options);
    REQUIRE(analysis.has_value());
    const auto& model = analysis->models[0];
    for (std::size_t i = 0; i < table.temperature_c.size(); i += 6) {
      const double fresh = truth(table.temperature_c[i]) + noise(random);
      inside += std::abs(fresh - model.fitted_dps[i]) < model.band_dps[i] ? 1 : 0;
      ++trials;
    }
  }
  CHECK(inside / static_cast<double>(trials) == Approx(0.95).margin(0.025));
}

TEST_CASE("a zero drift known ten times better pulls a polynomial, not the paper's methods",
          "[drift]") {
  AnalysisOptions plain;
  AnalysisOptions weighted;
  weighted.standard_error_dps.assign(25, 0.01);
  weighted.standard_error_dps[12] = 0.001;
  const auto without = analyse(paper_table_1(), plain);
  const auto with = analyse(paper_table_1(), weighted);
  REQUIRE(without.has_value());
  REQUIRE(with.has_value());
  const auto miss = [](const Analysis& a, const char* method) {
    const auto& m = model_named(a, method);
    return std::abs(m.fitted_dps[12] - m.measured_dps[12]);
  };
  CHECK(miss(*with, "polynomial_2") < 0.2 * miss(*without, "polynomial_2"));
  CHECK(miss(*with, "smoothing_spline") < miss(*without, "smoothing_spline"));
  CHECK(model_named(*with, "least_squares").fitted_dps ==
        model_named(*without, "least_squares").fitted_dps);
}

TEST_CASE("a constant series has models, no grade, and no failure", "[drift][bad input]") {
  const auto analysis = analyse(constant_table(12, 4.25));
  REQUIRE(analysis.has_value());
  CHECK(analysis->refused.empty());
  for (const auto& model : analysis->models) {
    CAPTURE(model.method);
    CHECK(model.training.max < 1e-9);
    CHECK(model.loocv_rmse_dps < 1e-9);
    CHECK_FALSE(model.grade.has_value());
  }
}

TEST_CASE("a series around zero is translated, fitted, and translated back", "[drift]") {
  DriftTable table = paper_table_1();
  for (double& drift : table.zero_drift_dps) drift -= 4.2;
  const auto analysis = analyse(table);
  REQUIRE(analysis.has_value());
  const auto& model = model_named(*analysis, "gm11");
  const auto translation = std::find_if(model.parameters.begin(), model.parameters.end(),
                                        [](const auto& p) { return p.name == "translation_dps"; });
  REQUIRE(translation != model.parameters.end());
  CHECK(translation->values.at(0) > 0.1772);  // the lowest value is 4.0228 - 4.2
  CHECK(model.fitted_dps[0] == Approx(table.zero_drift_dps[0]).margin(1e-12));
  CHECK(model.training.max < 0.1);
  CHECK(std::any_of(model.warnings.begin(), model.warnings.end(), [](const auto& w) {
    return w.find("was added before the fit") != std::string::npos;
  }));
}

TEST_CASE("a table too small for a method says so and keeps the others", "[drift][bad input]") {
  DriftTable table{{0, 10, 20, 30, 40}, {4.1, 4.15, 4.12, 4.2, 4.18}};
  const auto analysis = analyse(table);
  REQUIRE(analysis.has_value());
  REQUIRE(analysis->refused.size() == 2);
  CHECK(analysis->refused[0].method == "improved_gm11");
  CHECK(analysis->refused[1].method == "polynomial_5");
  CHECK(analysis->refused[1].error.what == "a polynomial of degree 5 needs 6 points, got 5");
  CHECK(std::isnan(model_named(*analysis, "polynomial_4").loocv_rmse_dps));
}

TEST_CASE("a residual polynomial the setpoints cannot carry is warned of", "[drift]") {
  DriftTable table = paper_table_1();
  table.temperature_c.resize(9);
  table.zero_drift_dps.resize(9);
  const auto analysis = analyse(table);
  REQUIRE(analysis.has_value());
  const auto& warnings = model_named(*analysis, "improved_gm11").warnings;
  REQUIRE_FALSE(warnings.empty());
  CHECK(warnings[0].starts_with("the residual polynomial of degree 5 is not supported by 9"));
}

TEST_CASE("tables that cannot be analysed are refused by name", "[drift][bad input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(analyse(DriftTable{}).error().code == Errc::too_few_points);
  CHECK(analyse({{20}, {4.1}}).error().code == Errc::too_few_points);
  CHECK(analyse({{20, 30}, {4.1}}).error().code == Errc::bad_input);
  CHECK(analyse({{20, 30, nan}, {4.1, 4.2, 4.3}}).error().code == Errc::not_finite);
  CHECK(analyse({{20, 30, 40}, {4.1, 4.2, nan}}).error().what ==
        "the zero drift at 40 degC is nan");
  CHECK(analyse({{20, 30, 30}, {4.1, 4.2, 4.3}}).error().what ==
        "setpoint 3 (30 degC) does not lie above setpoint 2 (30 degC)");
  AnalysisOptions options;
  options.standard_error_dps = {0.1, 0.0, 0.1};
  CHECK(analyse({{20, 30, 40}, {4.1, 4.2, 4.3}}, options).error().code == Errc::out_of_range);
}

TEST_CASE("the same table gives the same analysis to the last bit", "[drift]") {
  CHECK(analysis_to_json(*analyse(paper_table_1())).dump() ==
        analysis_to_json(*analyse(paper_table_1())).dump());
}
