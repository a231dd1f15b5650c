#include "compensation/drift/student_t.h"

#include <catch2/catch.hpp>

using gyrocal::student_t_two_sided;

TEST_CASE("Student's t at 95 % as every table has it", "[drift]") {
  CHECK(student_t_two_sided(0.95, 1) == Approx(12.7062).margin(5e-5));
  CHECK(student_t_two_sided(0.95, 2) == Approx(4.30265).margin(5e-6));
  CHECK(student_t_two_sided(0.95, 10) == Approx(2.22814).margin(5e-6));
  CHECK(student_t_two_sided(0.95, 22) == Approx(2.07387).margin(5e-6));
  CHECK(student_t_two_sided(0.95, 1e6) == Approx(1.95996).margin(1e-5));
  CHECK(student_t_two_sided(0.5, 1) == Approx(1.0).margin(1e-9));  // Cauchy: tan(pi / 4)
}
