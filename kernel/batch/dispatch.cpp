#include "kernel/batch/dispatch.h"

namespace trimloop {

InstructionSet best_instruction_set() {
#if defined(TRIMLOOP_X86_KERNELS)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return InstructionSet::Baseline;
  return __builtin_cpu_supports("avx512f") ? InstructionSet::Avx512 : InstructionSet::Avx2;
#else
  return InstructionSet::Baseline;
#endif
}

namespace batch {

const Kernels& kernels([[maybe_unused]] BatchOptions options) {
#if defined(TRIMLOOP_X86_KERNELS)
  const bool fast = options.arithmetic == Arithmetic::Fast;
  switch (std::min(options.at_most, best_instruction_set())) {
    case InstructionSet::Avx512:
      return fast ? avx512_fma_kernels : avx512_kernels;
    case InstructionSet::Avx2:
      return fast ? avx2_fma_kernels : avx2_kernels;
    case InstructionSet::Baseline:
      break;
  }
#endif
  return baseline_kernels;
}

}  // namespace batch
}  // namespace trimloop
