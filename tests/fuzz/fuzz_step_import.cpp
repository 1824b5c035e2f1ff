// libFuzzer target: bytes -> model of a STEP file. Seeds and kept crashers: tests/data/step.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/step_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = trimloop::test::broken_step_import({reinterpret_cast<const char*>(data), size})) {
    std::fprintf(stderr, "broken promise: %s\n", broken);
    std::abort();
  }
  return 0;
}
