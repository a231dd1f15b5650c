#pragma once

#include "compensation/wavelet/kernels.h"

namespace gyrocal {

const Kernels& portable_kernels();
// Only where the build has them (x86-64), and to be used only where the machine has them.
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

}  // namespace gyrocal
