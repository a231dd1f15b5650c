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
  static void split_vectors(const double* signal, double* even, double* odd,
                            std::index_sequence<I...>) {
    const V first = Lanes::load(signal);
    const V second = Lanes::load(signal + width);
    store<V>(even, __builtin_shufflevector(first, second, (2 * I)...));
    store<V>(odd, __builtin_shufflevector(first, second, (2 * I + 1)...));
  }

  static void split(const double* signal, std::size_t pairs, double* even, double* odd) {
    std::size_t at = 0;
    for (; at + width <= pairs; at += width) {
      split_vectors(signal + 2 * at, even + at, odd + at, Order());
    }
    for (; at < pairs; ++at) {
      even[at] = signal[2 * at];
      odd[at] = signal[2 * at + 1];
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
      if constexpr (PastCaches) {
        Lanes::store_past_caches(high + u * width, sum_high[u]);
      } else {
        store<V>(high + u * width, sum_high[u]);
      }
    }
  }

  static void analyse_one(const double* even, const double* odd, const double* lo, const double* hi,
                          std::size_t half_taps, double* low, double* high) {
    double sum_low = 0.0;
    double sum_high = 0.0;
    for (std::size_t t = 0; t < half_taps; ++t) {
      sum_low = __builtin_fma(lo[2 * t], even[t], sum_low);
      sum_high = __builtin_fma(hi[2 * t], even[t], sum_high);
      sum_low = __builtin_fma(lo[2 * t + 1], odd[t], sum_low);
      sum_high = __builtin_fma(hi[2 * t + 1], odd[t], sum_high);
    }
    *low = sum_low;
    *high = sum_high;
  }

  static void analyse(const double* even, const double* odd, std::size_t count, const double* lo,
                      const double* hi, std::size_t half_taps, double* low, double* high) {
    constexpr std::size_t tile = Lanes::analyse_side * width;
    std::size_t at = 0;
    for (; at + tile <= count; at += tile) {
      analyse_tile<Lanes::analyse_side, false>(even + at, odd + at, lo, hi, half_taps, low + at,
                                               high + at);
    }
    for (; at + width <= count; at += width) {
      analyse_tile<1, false>(even + at, odd + at, lo, hi, half_taps, low + at, high + at);
    }
    for (; at < count; ++at) {
      analyse_one(even + at, odd + at, lo, hi, half_taps, low + at, high + at);
    }
  }

  static void analyse_long(const double* even, const double* odd, std::size_t count,
                           const double* lo, const double* hi, std::size_t half_taps, double* low,
                           double* high, const double* next) {
    constexpr std::size_t tile = Lanes::analyse_side * width;
    constexpr std::size_t cache_line = 64 / sizeof(double);
    std::size_t at = 0;
    for (; at < count && reinterpret_cast<std::uintptr_t>(high + at) % sizeof(V) != 0; ++at) {
      analyse_one(even + at, odd + at, lo, hi, half_taps, low + at, high + at);
    }
    for (; at + tile <= count; at += tile) {
      for (std::size_t i = 0; next != nullptr && i < 2 * tile; i += cache_line) {
        __builtin_prefetch(next + 2 * at + i, 0, 1);
      }
      analyse_tile<Lanes::analyse_side, true>(even + at, odd + at, lo, hi, half_taps, low + at,
                                              high + at);
    }
    analyse(even + at, odd + at, count - at, lo, hi, half_taps, low + at, high + at);
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

  static constexpr Kernels kernels = {split, analyse, analyse_long, synthesise};
};

}  // namespace
}  // namespace gyrocal
