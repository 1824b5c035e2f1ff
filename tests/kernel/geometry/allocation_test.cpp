// Evaluation of the hot types takes nothing from the heap.

#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <new>

#include "shapes.h"

namespace {
std::atomic<std::size_t> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

using namespace trimloop;
using namespace trimloop::test;

BOOST_AUTO_TEST_SUITE(allocations_of)

BOOST_AUTO_TEST_CASE(evaluation_are_none) {
  double sum = 0;
  for (const Curve& c : every_curve()) {
    if (std::holds_alternative<OffsetCurve>(c.shape)) continue;  // the third derivative of a NURBS comes in a vector
    const std::size_t before = allocations;
    for (int i = 0; i <= 10; ++i) sum += evaluate(c, range(c).at(i / 10.0)).x + jet(c, range(c).at(i / 10.0)).d2.y;
    BOOST_TEST(allocations == before);
  }
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name) {
      const std::size_t before = allocations;
      for (int i = 0; i <= 10; ++i) {
        const Uv p{patch.u.at(i / 10.0), patch.v.at(0.3)};
        Point point;
        Vector du, dv;
        jet1(patch.surface, p, point, du, dv);
        sum += evaluate(patch.surface, p).x + jet(patch.surface, p).duv.y + normal(patch.surface, p).x + du.x;
        sum += closest_point_near(patch.surface, point + du, p).distance;
      }
      BOOST_TEST(allocations == before);
    }
  }
  BOOST_TEST(std::isfinite(sum));
}

BOOST_AUTO_TEST_SUITE_END()
