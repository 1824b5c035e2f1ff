#pragma once
// TRIMLOOP_ASSERT(condition, "sentence"): our own mistakes only, never a reaction to input.
// On in every build of the tests and of the program; an embedder may define TRIMLOOP_NO_ASSERT.

namespace trimloop::detail {
[[noreturn]] void assertion_failed(const char* condition, const char* sentence, const char* file, int line);
}

#ifdef TRIMLOOP_NO_ASSERT
#define TRIMLOOP_ASSERT(condition, sentence) ((void)0)
#else
#define TRIMLOOP_ASSERT(condition, sentence) \
  ((condition) ? (void)0 : ::trimloop::detail::assertion_failed(#condition, sentence, __FILE__, __LINE__))
#endif
