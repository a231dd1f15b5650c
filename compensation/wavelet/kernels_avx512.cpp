#include <immintrin.h>

#include "compensation/wavelet/kernels_body.h"
#include "compensation/wavelet/kernels_sets.h"

namespace gyrocal {
namespace {

struct EightLanes {
  using Vector = double __attribute__((vector_size(64)));
  static constexpr std::size_t analyse_side = 4;
  static constexpr std::size_t synthesise_side = 4;
  static Vector load(const double* from) {
    Vector value = _mm512_loadu_pd(from);
    asm("" : "+v"(value));  // else GCC loads it again for each of its two uses
    return value;
  }
  static constexpr bool shifts = true;
  static void store_past_caches(double* to, Vector value) { _mm512_stream_pd(to, value); }
  static Vector multiply_add(double factor, Vector x, Vector sum) {
    return _mm512_fmadd_pd(_mm512_set1_pd(factor), x, sum);
  }
};

}  // namespace

const Kernels& avx512_kernels() { return Body<EightLanes>::kernels; }

}  // namespace gyrocal
