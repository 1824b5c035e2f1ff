// The batch kernels for every processor of the target (SSE2 on x86-64).
#define TRIMLOOP_LANES 2
#include "kernel/batch/kernels.inc"

namespace trimloop::batch {
const Kernels baseline_kernels = kernels_of<false>();
}  // namespace trimloop::batch
