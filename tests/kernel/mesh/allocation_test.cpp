// A triangulation that is used again does not allocate: counted by replacing the program's operator new.

#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <new>

#include "kernel/mesh/triangulation.h"

namespace {
std::atomic<std::size_t> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace trimloop;
using namespace trimloop::mesh;

BOOST_AUTO_TEST_CASE(the_second_face_needs_no_more_memory_than_the_first) {
  std::vector<Uv> points;
  std::vector<Segment> constraints;
  const auto ring = [&](double radius, std::uint32_t n) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      points.push_back({radius * std::cos(two_pi * i / n), radius * std::sin(two_pi * i / n)});
      constraints.push_back({first + i, first + (i + 1) % n});
    }
  };
  ring(1, 64);
  ring(0.5, 20);
  constraints.push_back({0, 64 + 10});  // crosses the hole
  Triangulation t;
  BOOST_REQUIRE(t.build(points, constraints).has_value());
  t.classify(Inside::Odd);
  const std::size_t before = allocations;
  for (int k = 0; k < 10; ++k) {
    for (Uv& p : points) p = {p.u + 0.1 * k, p.v * 1.01};
    const bool built = t.build(points, constraints).has_value();
    t.classify(Inside::Odd);
    if (!built) break;
  }
  const std::size_t after = allocations;
  BOOST_TEST(before > 0u);
  BOOST_TEST(after == before);
}
