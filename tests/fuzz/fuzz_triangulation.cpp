// Any bytes become a triangulation of which every invariant holds (triangulation_property.h). Kept inputs:
// tests/data/fuzz_triangulation.

#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/triangulation_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string broken = trimloop::mesh::broken_by(bytes, size);
  if (!broken.empty()) {
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
  }
  return 0;
}
