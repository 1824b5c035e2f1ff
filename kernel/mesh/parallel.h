#pragma once
// Independent work over 0..count-1 on a few threads that draw indices from one counter. Results must be stored by
// index, never in order of arrival: that is what makes them the same for any number of threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace trimloop::mesh {

inline std::size_t worker_count(int jobs, std::size_t count) {
  return std::min(static_cast<std::size_t>(std::max(jobs, 1)), std::max<std::size_t>(count, 1));
}

// Calls work(worker, index) once for each index; `worker` is below worker_count(jobs, count).
template <class Work>
void for_each_index(std::size_t count, int jobs, Work work) {
  const std::size_t workers = worker_count(jobs, count);
  std::atomic<std::size_t> next{0};
  const auto drain = [&](std::size_t worker) {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) work(worker, i);
  };
  std::vector<std::jthread> threads;
  for (std::size_t w = 1; w < workers; ++w) threads.emplace_back(drain, w);
  drain(0);
}

}  // namespace trimloop::mesh
