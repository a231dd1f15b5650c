#pragma once

#include <cstddef>

namespace gyrocal {

/// Of the longest bank, coif5.
inline constexpr std::size_t max_half_taps = 15;

/// The inner loops of the transform. Every instruction set adds in the same order with the
/// same fused multiply-adds (one rounding), so all give the same result to the last bit.
struct Kernels {
  /// low(o) = sum over j < 2 half_taps of lo(j) signal(2o+j) for o < count; high likewise with hi.
  /// signal holds 2 (count + half_taps - 1) values.
  void (*analyse)(const double* signal, std::size_t count, const double* lo, const double* hi,
                  std::size_t half_taps, double* low, double* high);

  /// The same for signals longer than the caches: `high` goes past them (it is not read again
  /// soon, and memory need not be read before it is written), and meanwhile 2 count values from
  /// `next` on are fetched, if it is not null.
  void (*analyse_long)(const double* signal, std::size_t count, const double* lo, const double* hi,
                       std::size_t half_taps, double* low, double* high, const double* next);

  /// signal(2q) = sum over t < half_taps of lo(2t+1) low(q+t) + hi(2t+1) high(q+t), signal(2q+1)
  /// the same with lo(2t) and hi(2t), for q < pairs. low and high hold pairs + half_taps - 1
  /// values. A null `high` stands for zeros.
  void (*synthesise)(const double* low, const double* high, std::size_t pairs, const double* lo,
                     const double* hi, std::size_t half_taps, double* signal);
};

/// `portable` runs everywhere; without a fused multiply-add in hardware (x86 before 2013) it is
/// slow, not wrong. The others are x86-64 only.
enum class InstructionSet { portable, avx2, avx512 };

/// @return the loops compiled for that instruction set; null if this machine lacks it.
[[nodiscard]] const Kernels* kernels_for(InstructionSet set);

/// The loops for the widest instruction set of this machine, chosen at the first call.
[[nodiscard]] const Kernels& kernels();

}  // namespace gyrocal
