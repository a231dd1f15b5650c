#include "compensation/rig/portable_math.h"

#include <cmath>
#include <limits>

namespace gyrocal::rig {

double portable_exp(double x) {
  if (x > 709.0) return std::numeric_limits<double>::infinity();
  if (x < -745.0) return 0.0;
  // ln 2 in two parts: the first has trailing zeros, so that twos * ln2_head is exact.
  constexpr double ln2_head = 0.69314718036912381649;
  constexpr double ln2_tail = 1.90821492927058770002e-10;
  const double twos = std::floor(x / 0.69314718055994530942 + 0.5);
  const double rest = (x - twos * ln2_head) - twos * ln2_tail;
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + sum * rest / k;
  return std::ldexp(sum, static_cast<int>(twos));
}

double portable_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [0.5, 1)
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2.0;
    --exponent;
  }
  const double s = (mantissa - 1.0) / (mantissa + 1.0);  // ln m = 2 atanh s, |s| < 0.1716
  const double square = s * s;
  double sum = 0.0;
  for (int k = 23; k >= 1; k -= 2) sum = 1.0 / k + square * sum;
  return exponent * 0.69314718055994530942 + 2.0 * s * sum;
}

double portable_sine(double turns) {
  double part = turns - std::floor(turns + 0.5);  // [-0.5, 0.5)
  if (part > 0.25) part = 0.5 - part;
  if (part < -0.25) part = -0.5 - part;
  const double x = part * two_pi;
  const double square = x * x;
  double sum = 1.0;
  for (int k = 22; k >= 2; k -= 2) sum = 1.0 - sum * square / (k * (k + 1));
  return x * sum;
}

}  // namespace gyrocal::rig
