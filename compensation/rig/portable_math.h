#pragma once

namespace gyrocal::rig {

inline constexpr double two_pi = 6.28318530717958647692;

/// exp, log and sine that give the same bits on every machine. The C library chooses variants by
/// processor at run time and they differ in the last place, which would let one seed give two
/// different campaigns. Only + - * / of IEEE doubles are used here.

/// e^x. Relative error < 4e-16 for |x| <= 700; 0 below -745, infinity above 709.
[[nodiscard]] double portable_exp(double x);

/// Natural logarithm of a positive, finite x. Absolute error < 4e-16 * max(1, |ln x|).
[[nodiscard]] double portable_log(double x);

/// sin(2 pi turns). Absolute error < 4e-16 for |turns| < 2^20.
[[nodiscard]] double portable_sine(double turns);

}  // namespace gyrocal::rig
