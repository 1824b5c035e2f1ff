// The batch kernels for AVX-512; the root CMakeLists.txt gives this file its flags.
#if defined(__AVX512F__)
#define TRIMLOOP_LANES 8
#include "kernel/batch/kernels.inc"

namespace trimloop::batch {
const Kernels avx512_kernels = kernels_of<false>(), avx512_fma_kernels = kernels_of<true>();
}  // namespace trimloop::batch
#endif
