#include "base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace trimloop::detail {

void assertion_failed(const char* condition, const char* sentence, const char* file, int line) {
  std::fprintf(stderr, "trimloop: internal error: %s (%s) at %s:%d\n", sentence, condition, file, line);
  std::abort();
}

}  // namespace trimloop::detail
