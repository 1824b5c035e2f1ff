// libFuzzer target: bytes -> model of an IGES file. Seeds and kept crashers: tests/data/fuzz_iges.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/iges_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = trimloop::test::broken_iges_import({reinterpret_cast<const char*>(data), size})) {
    std::fprintf(stderr, "broken promise: %s\n", broken);
    std::abort();
  }
  return 0;
}
