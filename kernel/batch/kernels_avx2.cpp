// The batch kernels for AVX2 and FMA; the root CMakeLists.txt gives this file its flags.
#if defined(__AVX2__)
#define TRIMLOOP_LANES 4
#include "kernel/batch/kernels.inc"

namespace trimloop::batch {
const Kernels avx2_kernels = kernels_of<false>(), avx2_fma_kernels = kernels_of<true>();
}  // namespace trimloop::batch
#endif
