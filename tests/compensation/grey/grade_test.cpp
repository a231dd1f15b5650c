#include "compensation/grey/grade.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace gyrocal;

TEST_CASE("C and P of a series worked by hand", "[grey]") {
  const std::vector<double> measured{1, 2, 3, 4};    // S1 = sqrt(1.25)
  const std::vector<double> fitted{1, 2.5, 2.5, 4};  // residuals 0, -0.5, 0.5, 0: S2 = sqrt(0.125)
  const auto grade = grey_grade(measured, fitted);
  REQUIRE(grade.has_value());
  CHECK(grade->posterior_error_ratio == Approx(std::sqrt(0.1)));
  CHECK(grade->small_error_probability == 1.0);
  CHECK(grade->grade == "good");
}

TEST_CASE("a large residual costs the grade by P, a wide spread by C", "[grey]") {
  const std::vector<double> measured{1, 2, 3, 4, 5};  // S1 = sqrt(2)
  const auto graded = [&](const std::vector<double>& fitted) {
    return grey_grade(measured, fitted)->grade;
  };
  CHECK(graded({1, 2, 3, 4, 5}) == "good");
  CHECK(graded({1.9, 2, 3, 4, 4.1}) == "qualified");    // C 0.447, P 1
  CHECK(graded({2.2, 2, 3, 4, 3.8}) == "unqualified");  // |1.2| > 0.6745 S1: P 0.6
  CHECK(graded({3, 3, 3, 3, 3}) == "unqualified");
}

TEST_CASE("a constant series has no grade", "[grey]") {
  const std::vector<double> constant(6, 4.2);
  CHECK_FALSE(grey_grade(constant, constant).has_value());
}
