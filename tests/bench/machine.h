#pragma once
// What one core of this machine can do, measured: multiply-adds with operands in registers, and stores.

#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace trimloop::bench {

// Seconds of the fastest of `times` runs.
template <class Body>
double fastest(int times, Body body) {
  double best = 1e300;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    body();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

// Twelve independent chains; an empty asm keeps the compiler from seeing through them.
#define TRIMLOOP_PEAK(name, flags, type, width, operation)         \
  __attribute__((target(flags))) inline double name(long rounds) { \
    type a[12];                                                    \
    for (auto& x : a) x = type{} + 1.0;                            \
    type m = type{} + 0.999999, s = type{} + 1e-6;                 \
    asm volatile("" : "+x"(m), "+x"(s));                           \
    for (long i = 0; i < rounds; ++i)                              \
      for (int k = 0; k < 12; ++k) a[k] = operation;               \
    double sum = 0;                                                \
    for (auto& x : a) sum += x[0];                                 \
    asm volatile("" : : "x"(sum));                                 \
    return 12.0 * width * static_cast<double>(rounds);             \
  }
typedef double Two __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));
TRIMLOOP_PEAK(peak_sse2, "sse2", Two, 2, a[k] * m + s)
TRIMLOOP_PEAK(peak_avx2, "avx2,fma", Four, 4, (Four)_mm256_fmadd_pd((__m256d)a[k], (__m256d)m, (__m256d)s))
TRIMLOOP_PEAK(peak_avx512, "avx512f", Eight, 8, (Eight)_mm512_fmadd_pd((__m512d)a[k], (__m512d)m, (__m512d)s))
#undef TRIMLOOP_PEAK

// Multiply-adds (of one number) a second.
template <class Peak>
double peak_rate(Peak peak) {
  double done = 0;
  const double seconds = fastest(20, [&] { done = peak(200000); });
  return done / seconds;
}

// Bytes a second stored to a buffer, plain (in cache, to memory) and past the caches.
struct StoreRates {
  double cached, plain, streamed;
};
inline void fill(double* to, std::size_t count) {
  const __m128d value = _mm_set1_pd(1);
  for (std::size_t i = 0; i < count; i += 2) _mm_store_pd(to + i, value);
  asm volatile("" : : "r"(to) : "memory");
}
inline void stream(double* to, std::size_t count) {
  const __m128d value = _mm_set1_pd(1);
  for (std::size_t i = 0; i < count; i += 2) _mm_stream_pd(to + i, value);
  _mm_sfence();
}
inline StoreRates store_rates() {
  const std::size_t count = std::size_t{1} << 23, small = 2048;  // 64 MB, 16 KB
  std::vector<double> buffer(count + 8);
  double* to = buffer.data();
  while (reinterpret_cast<std::size_t>(to) % 64 != 0) ++to;
  const auto bytes = static_cast<double>(8 * count);
  return {bytes / fastest(10,
                          [&] {
                            for (std::size_t i = 0; i < count / small; ++i) fill(to, small);
                          }),
          bytes / fastest(10, [&] { fill(to, count); }), bytes / fastest(10, [&] { stream(to, count); })};
}

}  // namespace trimloop::bench
