#include "compensation/drift/left_over.h"

#include <catch2/catch.hpp>

using namespace gyrocal;

TEST_CASE("what is left, worked by hand", "[drift]") {
  const auto left = left_over(std::vector<double>{1, -3, 2});
  CHECK(left.mean_dps == 0);
  CHECK(left.rms_dps == Approx(std::sqrt(14.0 / 3)));
  CHECK(left.standard_deviation_dps == Approx(std::sqrt(7.0)));
  CHECK(left.max_dps == 3);
  CHECK(left_over(std::vector<double>{2}).standard_deviation_dps == 0);
}

TEST_CASE("rows a model was fitted to are counted", "[drift]") {
  FittedModel model;
  model.setpoint_c = {0, 10, 20};
  model.measured_dps = {4, 4.1, 4.2};
  CHECK(rows_of_training(model, std::vector<double>{0, 10, 15},
                         std::vector<double>{4, 4.15, 4.2}) == 1);
  CHECK(rows_of_training(model, model.setpoint_c, model.measured_dps) == 3);
}
