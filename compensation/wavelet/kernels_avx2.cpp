#include <immintrin.h>

#include "compensation/wavelet/kernels_body.h"
#include "compensation/wavelet/kernels_sets.h"

namespace gyrocal {
namespace {

struct FourLanes {
  using Vector = double __attribute__((vector_size(32)));
  static constexpr std::size_t analyse_side = 3;
  static constexpr std::size_t synthesise_side = 3;
  static Vector load(const double* from) {
    Vector value = _mm256_loadu_pd(from);
    asm("" : "+x"(value));  // else GCC loads it again for each of its two uses
    return value;
  }
  static constexpr bool shifts = false;
  static void store_past_caches(double* to, Vector value) { _mm256_stream_pd(to, value); }
  static Vector multiply_add(double factor, Vector x, Vector sum) {
    return _mm256_fmadd_pd(_mm256_set1_pd(factor), x, sum);
  }
};

}  // namespace

const Kernels& avx2_kernels() { return Body<FourLanes>::kernels; }

}  // namespace gyrocal
