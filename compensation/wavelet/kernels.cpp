#include "compensation/wavelet/kernels.h"

#include "compensation/wavelet/kernels_sets.h"

namespace gyrocal {

const Kernels* kernels_for(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &avx2_kernels()
                                                                           : nullptr;
  }
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") ? &avx512_kernels() : nullptr;
  }
#endif
  return set == InstructionSet::portable ? &portable_kernels() : nullptr;
}

const Kernels& kernels() {
  static const Kernels& widest = []() -> const Kernels& {
    if (const Kernels* found = kernels_for(InstructionSet::avx512)) return *found;
    if (const Kernels* found = kernels_for(InstructionSet::avx2)) return *found;
    return portable_kernels();
  }();
  return widest;
}

}  // namespace gyrocal
