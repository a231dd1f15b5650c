#include "compensation/drift/curve.h"

#include <catch2/catch.hpp>

#include "compensation/drift/analysis.h"
#include "compensation/drift/paper.h"
#include "config/drift_model/model_json.h"

using namespace gyrocal;

TEST_CASE("every model read back from its JSON evaluates to the same bits", "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  REQUIRE(analysis->models.size() == all_methods().size());
  for (const auto& model : analysis->models) {
    CAPTURE(model.method);
    const auto text = model_to_json(model).dump();
    const auto again = model_from_json(nlohmann::ordered_json::parse(text));
    REQUIRE(again.has_value());
    CHECK(again->parameters == model.parameters);
    CHECK(again->warnings == model.warnings);
    for (double t = -10; t <= 50; t += 0.37) {
      CHECK(evaluate(*again, {t}).value() == evaluate(model, {t}).value());
    }
    for (std::size_t i = 0; i < model.setpoint_c.size(); ++i) {
      CHECK(evaluate(model, {model.setpoint_c[i]}).value() == model.fitted_dps[i]);
    }
  }
}

TEST_CASE("a model refuses to leave its setpoints unless told", "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  for (const auto& model : analysis->models) {
    CAPTURE(model.method);
    const auto refused = evaluate(model, {50.01});
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == Errc::out_of_range);
    CHECK(refused.error().what == "50.01 degC lies outside the calibrated -10 to 50 degC");
    CHECK_FALSE(evaluate(model, {-10.5}).has_value());
    CHECK(evaluate(model, {50.01}, Extrapolation::allow).value() ==
          Approx(model.fitted_dps.back()).margin(0.01));
    CHECK(evaluate(model, {std::nan("")}).error().code == Errc::not_finite);
  }
}

TEST_CASE("curves are continuous at the setpoints, the grey ones too", "[drift]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  for (const auto& model : analysis->models) {
    for (std::size_t i = 1; i + 1 < model.setpoint_c.size(); ++i) {
      const double t = model.setpoint_c[i];
      CHECK(evaluate(model, {t - 1e-9}).value() == Approx(model.fitted_dps[i]).margin(1e-8));
      CHECK(evaluate(model, {t + 1e-9}).value() == Approx(model.fitted_dps[i]).margin(1e-8));
    }
  }
}

TEST_CASE("damaged parameters are refused with the parameter's name", "[drift][bad input]") {
  const auto analysis = analyse(paper_table_1());
  REQUIRE(analysis.has_value());
  for (const auto& model : analysis->models) {
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      auto without = model;
      without.parameters.erase(without.parameters.begin() + static_cast<std::ptrdiff_t>(i));
      const auto missing_one = evaluate(without, {20});
      REQUIRE_FALSE(missing_one.has_value());
      CHECK(missing_one.error().code == Errc::bad_input);
      CHECK(missing_one.error().what.find(model.parameters[i].name) != std::string::npos);
      auto broken = model;
      broken.parameters[i].values = {std::nan("")};
      CHECK_FALSE(evaluate(broken, {20}).has_value());
    }
  }
  FittedModel unknown;
  unknown.method = "kalman";
  CHECK(evaluate(unknown, {20}).error().code == Errc::unknown_name);
}
