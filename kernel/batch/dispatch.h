#pragma once
// Which build of the batch kernels runs (not part of the public face).

#include "kernel/batch/batch.h"
#include "kernel/batch/kernels.h"

namespace trimloop::batch {

const Kernels& kernels(BatchOptions);

}  // namespace trimloop::batch
