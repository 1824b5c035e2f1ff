#pragma once
// Ceilings, cancellation and progress: what long or hostile work may cost.
// Every limit on input has its name here; a parser checks it before it allocates.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

namespace trimloop {

struct Limits {
  std::size_t file_bytes = std::size_t{4} << 30;      // LM-01: larger files are refused
  std::size_t memory_bytes = std::size_t{16} << 30;   // LM-02
  std::size_t list_count = 50'000'000;                // LM-03: entries in one list of one record
  std::size_t nesting_depth = 64;                     // LM-05: transforms, composites, subfigures, ...
  std::size_t instances = 1'000'000;                  // LM-07: occurrences after expansion
  double seconds = 0;                                 // LM-08: 0 = no limit
  int degree = 64;                                    // LM-04: of a curve or surface
  std::size_t triangles = 200'000'000;                // LM-09: in one mesh
};

// How long work is carried out. No global pool: each call that may take long receives one of these.
struct Execution {
  int jobs = 1;                                  // threads; results do not depend on it
  std::stop_token stop;                          // set to end early with ErrorCode::Cancelled
  std::function<void(double done)> progress;     // 0..1, from the calling thread, may be empty
  Limits limits;
};

// a + b and a * b in size_t, or nothing on overflow. Counts that come from a file go through these.
inline std::optional<std::size_t> checked_add(std::size_t a, std::size_t b) {
  if (a > SIZE_MAX - b) return std::nullopt;
  return a + b;
}
inline std::optional<std::size_t> checked_mul(std::size_t a, std::size_t b) {
  if (a != 0 && b > SIZE_MAX / a) return std::nullopt;
  return a * b;
}

}  // namespace trimloop
