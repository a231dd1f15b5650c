#include "compensation/wavelet/kernels_body.h"
#include "compensation/wavelet/kernels_sets.h"

namespace gyrocal {
namespace {

struct TwoLanes {
  using Vector = double __attribute__((vector_size(16)));
  static constexpr std::size_t analyse_side = 2;
  static constexpr std::size_t synthesise_side = 2;
  static Vector load(const double* from) { return Vector{from[0], from[1]}; }
  static constexpr bool shifts = false;
  static void store_past_caches(double* to, Vector value) { store<Vector>(to, value); }
  static Vector multiply_add(double factor, Vector x, Vector sum) {
    return Vector{__builtin_fma(factor, x[0], sum[0]), __builtin_fma(factor, x[1], sum[1])};
  }
};

}  // namespace

const Kernels& portable_kernels() { return Body<TwoLanes>::kernels; }

}  // namespace gyrocal
