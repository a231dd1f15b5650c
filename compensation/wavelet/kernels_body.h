#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "compensation/wavelet/kernels.h"

// The bodies of the kernels, compiled once for each instruction set: kernels_portable.cpp,
// kernels_avx2.cpp, kernels_avx512.cpp. All is local to the including file, so that no function
// compiled for a wide machine can stand in for another's.
//
// `Lanes` gives the compiler's vector type (GCC and Clang), the vectors summed side by side (enough
// independent sums in flight hide the latency of each, too many spill), load and multiply-add.

namespace gyrocal {
namespace {

constexpr std::size_t block_outputs = 512;  // even and odd part of a block stay in the L1 cache

template <class V>
void store(double* to, V value) {
  __builtin_memcpy(to, &value, sizeof(V));
}

template <class Lanes>
struct Body {
  using V = typename Lanes::Vector;
  static constexpr std::size_t width = sizeof(V) / sizeof(double);
  using Order = std::make_index_sequence<width>;

  template <std::size_t... I>
  [[gnu::always_inline]] static inline void split_vectors(const double* signal, V& even, V& odd,
                                                          std::index_sequence<I...>) {
    const V first = Lanes::load(signal);
    const V second = Lanes::load(signal + width);
    even = __builtin_shufflevector(first, second, (2 * I)...);
    odd = __builtin_shufflevector(first, second, (2 * I + 1)...);
  }

  /// even(k) = signal(2k), odd(k) = signal(2k+1) for k < pairs.
  static void split(const double* signal, std::size_t pairs, double* even, double* odd) {
    std::size_t at = 0;
    for (; at + width <= pairs; at += width) {
      V vector_even;
      V vector_odd;
      split_vectors(signal + 2 * at, vector_even, vector_odd, Order());
      store<V>(even + at, vector_even);
      store<V>(odd + at, vector_odd);
    }
    for (; at < pairs; ++at) {
      even[at] = signal[2 * at];
      odd[at] = signal[2 * at + 1];
    }
  }

  template <bool PastCaches>
  [[gnu::always_inline]] static inline void store_high(double* to, V value) {
    if constexpr (PastCaches) {
      Lanes::store_past_caches(to, value);
    } else {
      store<V>(to, value);
    }
  }

  template <std::size_t Side, bool PastCaches>
  [[gnu::always_inline]] static inline void analyse_tile(const double* even, const double* odd,
                                                         const double* lo, const double* hi,
                                                         std::size_t half_taps, double* low,
                                                         double* high) {
    V sum_low[Side] = {};
    V sum_high[Side] = {};
    for (std::size_t t = 0; t < half_taps; ++t) {
      for (std::size_t u = 0; u < Side; ++u) {
        const V e = Lanes::load(even + t + u * width);
        const V o = Lanes::load(odd + t + u * width);
        sum_low[u] = Lanes::multiply_add(lo[2 * t], e, sum_low[u]);
        sum_high[u] = Lanes::multiply_add(hi[2 * t], e, sum_high[u]);
        sum_low[u] = Lanes::multiply_add(lo[2 * t + 1], o, sum_low[u]);
        sum_high[u] = Lanes::multiply_add(hi[2 * t + 1], o, sum_high[u]);
      }
    }
    for (std::size_t u = 0; u < Side; ++u) {
      store<V>(low + u * width, sum_low[u]);
      store_high<PastCaches>(high + u * width, sum_high[u]);
    }
  }

  static void analyse_one(const double* signal, const double* lo, const double* hi,
                          std::size_t half_taps, double* low, double* high) {
    double sum_low = 0.0;
    double sum_high = 0.0;
    for (std::size_t t = 0; t < 2 * half_taps; ++t) {
      sum_low = __builtin_fma(lo[t], signal[t], sum_low);
      sum_high = __builtin_fma(hi[t], signal[t], sum_high);
    }
    *low = sum_low;
    *high = sum_high;
  }

  static void fetch(const double* from, std::size_t values) {
    constexpr std::size_t cache_line = 64 / sizeof(double);
    for (std::size_t i = 0; i < values; i += cache_line) __builtin_prefetch(from + i, 0, 1);
  }

  /// Even and odd values of a block laid out apart, then summed: for filters of any length.
  template <bool PastCaches>
  static void analyse_blocks(const double* signal, std::size_t count, const double* lo,
                             const double* hi, std::size_t half_taps, double* low, double* high,
                             const double* next) {
    constexpr std::size_t tile = Lanes::analyse_side * width;
    alignas(64) double even[block_outputs + max_half_taps];
    alignas(64) double odd[block_outputs + max_half_taps];
    for (std::size_t begin = 0; begin < count; begin += block_outputs) {
      const std::size_t outputs = count - begin < block_outputs ? count - begin : block_outputs;
      split(signal + 2 * begin, outputs + half_taps - 1, even, odd);
      std::size_t at = 0;
      for (; at + tile <= outputs; at += tile) {
        if (next != nullptr) fetch(next + 2 * (begin + at), 2 * tile);
        analyse_tile<Lanes::analyse_side, PastCaches>(even + at, odd + at, lo, hi, half_taps,
                                                      low + begin + at, high + begin + at);
      }
      for (; at + width <= outputs; at += width) {
        analyse_tile<1, PastCaches>(even + at, odd + at, lo, hi, half_taps, low + begin + at,
                                    high + begin + at);
      }
      for (; at < outputs; ++at) {
        analyse_one(signal + 2 * (begin + at), lo, hi, half_taps, low + begin + at,
                    high + begin + at);
      }
    }
  }

  /// `here` and `next` back to back, from lane T on.
  template <std::size_t T, std::size_t... I>
  [[gnu::always_inline]] static inline V shifted(V here, V next, std::index_sequence<I...>) {
    return __builtin_shufflevector(here, next, (T + I)...);
  }

  template <std::size_t... T>
  [[gnu::always_inline]] static inline void roll(const V (&even)[2], const V (&odd)[2],
                                                 const double* lo, const double* hi, V& sum_low,
                                                 V& sum_high, std::index_sequence<T...>) {
    const auto step = [&](std::size_t t, V e, V o) {
      sum_low = Lanes::multiply_add(lo[2 * t], e, sum_low);
      sum_high = Lanes::multiply_add(hi[2 * t], e, sum_high);
      sum_low = Lanes::multiply_add(lo[2 * t + 1], o, sum_low);
      sum_high = Lanes::multiply_add(hi[2 * t + 1], o, sum_high);
    };
    (step(T, shifted<T>(even[0], even[1], Order()), shifted<T>(odd[0], odd[1], Order())), ...);
  }

  /// Even and odd values stay in registers and are shifted there: for short filters on machines
  /// that shift over all lanes. @return outputs done; the rest has no whole vectors left.
  template <std::size_t HalfTaps, bool PastCaches>
  static std::size_t analyse_rolling(const double* signal, std::size_t count, const double* lo,
                                     const double* hi, double* low, double* high,
                                     const double* next) {
    if (count + HalfTaps < 2 * width + 1) return 0;
    // Copies, which no store to the bands can change: they may stay in registers.
    double own_lo[2 * HalfTaps];
    double own_hi[2 * HalfTaps];
    __builtin_memcpy(own_lo, lo, sizeof own_lo);
    __builtin_memcpy(own_hi, hi, sizeof own_hi);
    V even[2];
    V odd[2];
    split_vectors(signal, even[0], odd[0], Order());
    std::size_t at = 0;
    for (; at + 2 * width + 1 <= count + HalfTaps; at += width) {
      split_vectors(signal + 2 * (at + width), even[1], odd[1], Order());
      if (next != nullptr) fetch(next + 2 * at, 2 * width);
      V sum_low = {};
      V sum_high = {};
      roll(even, odd, own_lo, own_hi, sum_low, sum_high, std::make_index_sequence<HalfTaps>());
      store<V>(low + at, sum_low);
      store_high<PastCaches>(high + at, sum_high);
      even[0] = even[1];
      odd[0] = odd[1];
    }
    return at;
  }

  template <bool PastCaches, std::size_t... I>
  static std::size_t analyse_short_filter(const double* signal, std::size_t count, const double* lo,
                                          const double* hi, std::size_t half_taps, double* low,
                                          double* high, const double* next,
                                          std::index_sequence<I...>) {
    std::size_t done = 0;
    ((half_taps == I + 1 &&
      (done = analyse_rolling<I + 1, PastCaches>(signal, count, lo, hi, low, high, next)) > 0) ||
     ...);
    return done;
  }

  template <bool PastCaches>
  static void analyse_all(const double* signal, std::size_t count, const double* lo,
                          const double* hi, std::size_t half_taps, double* low, double* high,
                          const double* next) {
    std::size_t done = 0;
    if constexpr (Lanes::shifts) {
      done = analyse_short_filter<PastCaches>(signal, count, lo, hi, half_taps, low, high, next,
                                              Order());
      if (next != nullptr) next += 2 * done;
    }
    analyse_blocks<PastCaches>(signal + 2 * done, count - done, lo, hi, half_taps, low + done,
                               high + done, next);
  }

  static void analyse(const double* signal, std::size_t count, const double* lo, const double* hi,
                      std::size_t half_taps, double* low, double* high) {
    analyse_all<false>(signal, count, lo, hi, half_taps, low, high, nullptr);
  }

  static void analyse_long(const double* signal, std::size_t count, const double* lo,
                           const double* hi, std::size_t half_taps, double* low, double* high,
                           const double* next) {
    std::size_t at = 0;
    for (; at < count && reinterpret_cast<std::uintptr_t>(high + at) % sizeof(V) != 0; ++at) {
      analyse_one(signal + 2 * at, lo, hi, half_taps, low + at, high + at);
    }
    analyse_all<true>(signal + 2 * at, count - at, lo, hi, half_taps, low + at, high + at, next);
  }

  template <std::size_t... I>
  static void merge_vectors(V even, V odd, double* signal, std::index_sequence<I...>) {
    store<V>(signal, __builtin_shufflevector(even, odd, (I / 2 + I % 2 * width)...));
    store<V>(signal + width,
             __builtin_shufflevector(even, odd, (width / 2 + I / 2 + I % 2 * width)...));
  }

  template <std::size_t Side, bool WithHigh>
  [[gnu::always_inline]] static inline void synthesise_tile(const double* low, const double* high,
                                                            const double* lo, const double* hi,
                                                            std::size_t half_taps, double* signal) {
    V even[Side] = {};
    V odd[Side] = {};
    for (std::size_t t = 0; t < half_taps; ++t) {
      for (std::size_t u = 0; u < Side; ++u) {
        const V l = Lanes::load(low + t + u * width);
        even[u] = Lanes::multiply_add(lo[2 * t + 1], l, even[u]);
        odd[u] = Lanes::multiply_add(lo[2 * t], l, odd[u]);
        if constexpr (WithHigh) {
          const V h = Lanes::load(high + t + u * width);
          even[u] = Lanes::multiply_add(hi[2 * t + 1], h, even[u]);
          odd[u] = Lanes::multiply_add(hi[2 * t], h, odd[u]);
        }
      }
    }
    for (std::size_t u = 0; u < Side; ++u) {
      merge_vectors(even[u], odd[u], signal + 2 * u * width, Order());
    }
  }

  template <bool WithHigh>
  static void synthesise_one(const double* low, const double* high, const double* lo,
                             const double* hi, std::size_t half_taps, double* signal) {
    double even = 0.0;
    double odd = 0.0;
    for (std::size_t t = 0; t < half_taps; ++t) {
      even = __builtin_fma(lo[2 * t + 1], low[t], even);
      odd = __builtin_fma(lo[2 * t], low[t], odd);
      if constexpr (WithHigh) {
        even = __builtin_fma(hi[2 * t + 1], high[t], even);
        odd = __builtin_fma(hi[2 * t], high[t], odd);
      }
    }
    signal[0] = even;
    signal[1] = odd;
  }

  template <bool WithHigh>
  static void synthesise_bands(const double* low, const double* high, std::size_t pairs,
                               const double* lo, const double* hi, std::size_t half_taps,
                               double* signal) {
    constexpr std::size_t tile = Lanes::synthesise_side * width;
    std::size_t at = 0;
    for (; at + tile <= pairs; at += tile) {
      synthesise_tile<Lanes::synthesise_side, WithHigh>(low + at, high + at, lo, hi, half_taps,
                                                        signal + 2 * at);
    }
    for (; at + width <= pairs; at += width) {
      synthesise_tile<1, WithHigh>(low + at, high + at, lo, hi, half_taps, signal + 2 * at);
    }
    for (; at < pairs; ++at) {
      synthesise_one<WithHigh>(low + at, high + at, lo, hi, half_taps, signal + 2 * at);
    }
  }

  static void synthesise(const double* low, const double* high, std::size_t pairs, const double* lo,
                         const double* hi, std::size_t half_taps, double* signal) {
    if (high == nullptr) return synthesise_bands<false>(low, low, pairs, lo, hi, half_taps, signal);
    synthesise_bands<true>(low, high, pairs, lo, hi, half_taps, signal);
  }

  static constexpr Kernels kernels = {analyse, analyse_long, synthesise};
};

}  // namespace
}  // namespace gyrocal
